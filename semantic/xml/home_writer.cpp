// SPDX-License-Identifier: Apache-2.0
#include "semantic/xml/home_writer.h"

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/base/error.h"
#include "semantic/xml/home_nodes.h"
#include "semantic/xml/home_reader.h"
#include "semantic/xml/xml_layout.h"

namespace oikos::semantic {

namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

void append(std::string& out, const XmlNode& node, const std::string& indent);

void appendBody(std::string& out, const XmlNode& node, const std::string& indent) {
  if (node.children.empty()) {
    out += node.text.empty() ? "/>" : ">" + escapedText(node.text) + "</" + node.name + ">";
    return;
  }
  out += '>';
  for (const XmlNode& child : node.children) {
    out += "\n  " + indent;
    append(out, child, indent + "  ");
  }
  out += "\n" + indent + "</" + node.name + ">";
}

/// The whole element, its first line not indented.
void append(std::string& out, const XmlNode& unwritten, const std::string& indent) {
  XmlNode node = unwritten;
  writeOut(node);
  out += "<" + node.name;
  for (const auto& [name, value] : node.attributes) {
    out += " " + name + "=\"" + escapedAttribute(value) + "\"";
  }
  appendBody(out, node, indent);
}

/// The numbers of a longest strictly increasing subsequence; kNone is never in it.
std::vector<bool> longestIncreasing(const std::vector<std::size_t>& values) {
  std::vector<std::size_t> last_of_length;  // the position whose value ends the increasing run of this length at the least
  std::vector<std::size_t> previous(values.size(), kNone);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] == kNone) {
      continue;
    }
    const auto slot = std::lower_bound(last_of_length.begin(), last_of_length.end(), values[i],
                                       [&](std::size_t position, std::size_t value) { return values[position] < value; });
    previous[i] = slot == last_of_length.begin() ? kNone : *(slot - 1);
    if (slot == last_of_length.end()) {
      last_of_length.push_back(i);
    } else {
      *slot = i;
    }
  }
  std::vector<bool> chosen(values.size(), false);
  for (std::size_t i = last_of_length.empty() ? kNone : last_of_length.back(); i != kNone; i = previous[i]) {
    chosen[i] = true;
  }
  return chosen;
}

/// The space that an element's line begins with; empty if something else stands before it in its line.
std::string indentAt(std::string_view bytes, std::size_t begin) {
  const std::size_t line = bytes.substr(0, begin).find_last_of('\n');
  const std::size_t start = line == std::string_view::npos ? 0 : line + 1;
  const std::string_view before = bytes.substr(start, begin - start);
  return before.find_first_not_of(" \t") == std::string_view::npos ? std::string(before) : "";
}

/// `text` whose lines after the first began with `from` at least, now with `to`.
std::string reindented(std::string_view text, std::string_view from, std::string_view to) {
  std::string moved;
  for (;;) {
    const std::size_t line_end = text.find('\n');
    moved += text.substr(0, line_end == std::string_view::npos ? text.size() : line_end + 1);
    if (line_end == std::string_view::npos) {
      return moved;
    }
    text.remove_prefix(line_end + 1);
    if (text.starts_with(from)) {
      text.remove_prefix(from.size());
      moved += to;
    }
  }
}

/// Elements that form one list share a name here: furniture stands in one order, whether it is articulated or not.
std::string_view listOf(std::string_view element) {
  return element == "largeArticulatedObject" ? "largeObject" : element;
}

/// What becomes of one element's children.
struct ChildrenPlan {
  std::vector<const XmlNode*> before;                        ///< of each child in the file: what it is
  std::vector<const XmlNode*> after;                         ///< what it becomes; null: it goes
  std::map<std::size_t, std::vector<const XmlNode*>> added;  ///< behind which child (kNone: before the first) what comes in
};

class Splicer {
 public:
  Splicer(std::string_view bytes, const Home& before, const Home& after)
      : bytes_(bytes), elements_(layOut(bytes)), before_home_(before), after_home_(after) {}

  std::string run() {
    const WrittenAnyway anyway{hasChild("dock"), hasChild("vocabulary")};
    const bool same_words = before_home_.vocabulary == after_home_.vocabulary;
    XmlNode before = nodeOf(before_home_, anyway);
    XmlNode after = nodeOf(after_home_, {anyway.dock, anyway.vocabulary && same_words});
    std::string out(bytes_.substr(0, elements_[0].begin));
    out.reserve(bytes_.size() + bytes_.size() / 8);
    merge(out, 0, before, after);
    out += bytes_.substr(elements_[0].end);
    return out;
  }

 private:
  [[nodiscard]] std::string_view tag(std::uint32_t element) const {
    return bytes_.substr(elements_[element].begin, elements_[element].tag_end - elements_[element].begin);
  }

  [[nodiscard]] std::vector<std::uint32_t> childrenOf(std::uint32_t element) const {
    std::vector<std::uint32_t> children;
    for (std::uint32_t child = elements_[element].first; child != LaidElement::kNone; child = elements_[child].next) {
      children.push_back(child);
    }
    return children;
  }

  [[nodiscard]] bool hasChild(std::string_view name) const {
    const std::vector<std::uint32_t> children = childrenOf(0);
    return std::any_of(children.begin(), children.end(), [&](std::uint32_t child) { return tagName(tag(child)) == name; });
  }

  void merge(std::string& out, std::uint32_t element, XmlNode& before, XmlNode& after) {
    const LaidElement& laid = elements_[element];
    if (isSame(before, after)) {
      out += bytes_.substr(laid.begin, laid.end - laid.begin);
      return;
    }
    writeOut(before);
    writeOut(after);
    if (before.whole || before.name != after.name || (before.children.empty() && after.children.empty() && before.text != after.text)) {
      append(out, after, indentAt(bytes_, laid.begin));
      return;
    }
    mergeTag(out, element, before, after);
    mergeChildren(out, element, before, after);
  }

  void mergeTag(std::string& out, std::uint32_t element, const XmlNode& before, const XmlNode& after) const {
    const std::string_view text = tag(element);
    std::map<std::string_view, std::string_view> missing(after.attributes.begin(), after.attributes.end());
    std::map<std::string_view, std::string_view> old(before.attributes.begin(), before.attributes.end());
    const std::map<std::string_view, std::string_view> wanted = missing;
    std::size_t at = 0;
    for (const LaidAttribute& attribute : attributesOfTag(text)) {
      const auto is = old.find(attribute.name);
      const auto becomes = wanted.find(attribute.name);
      missing.erase(attribute.name);
      if (becomes == wanted.end() && is != old.end()) {
        out += text.substr(at, attribute.begin - at);  // without it
        at = attribute.end;
      } else if (becomes != wanted.end() && (is == old.end() || is->second != becomes->second)) {
        out += text.substr(at, attribute.value_begin - at);
        out += escapedAttribute(becomes->second);
        at = attribute.value_end;
      }
    }
    const std::size_t tail = text.find_last_not_of(" \t\r\n", text.size() - (isEmptyTag(text) ? 3 : 2)) + 1;
    out += text.substr(at, tail - at);
    for (const auto& [name, value] : after.attributes) {
      if (const auto is = old.find(name); missing.contains(name) && (is == old.end() || is->second != value)) {
        out += " " + name + "=\"" + escapedAttribute(value) + "\"";
      }
    }
    out += text.substr(tail);
  }

  static bool isEmptyTag(std::string_view tag) { return tag[tag.size() - 2] == '/'; }

  void mergeChildren(std::string& out, std::uint32_t element, XmlNode& before, XmlNode& after) {
    const LaidElement& laid = elements_[element];
    if (isEmptyTag(tag(element))) {
      appendIntoEmpty(out, element, after);
      return;
    }
    const std::vector<std::uint32_t> children = childrenOf(element);
    const ChildrenPlan plan = planFor(children, before, after);
    const std::string indent = children.empty() ? indentAt(bytes_, laid.begin) + "  " : indentAt(bytes_, elements_[children.front()].begin);
    add(out, plan, kNone, indent);
    std::size_t at = laid.tag_end;
    for (std::size_t i = 0; i < children.size(); ++i) {
      const LaidElement& child = elements_[children[i]];
      const std::string_view gap = bytes_.substr(at, child.begin - at);
      at = child.end;
      if (plan.after[i] != nullptr) {
        out += gap;
        XmlNode old = *plan.before[i];
        XmlNode changed = *plan.after[i];
        merge(out, children[i], old, changed);
      } else {
        out += gap.substr(0, gap.find_last_not_of(" \t\r") == std::string_view::npos ? 0 : lineEndOf(gap));
      }
      add(out, plan, i, indent);
    }
    out += bytes_.substr(at, laid.close - at);
    if (children.empty() && !plan.added.empty()) {
      out += "\n" + indentAt(bytes_, laid.begin);
    }
    out += bytes_.substr(laid.close, laid.end - laid.close);
  }

  /// Where the line before a removed element ends: what is behind it was only there for the element.
  static std::size_t lineEndOf(std::string_view gap) {
    const std::size_t last = gap.find_last_not_of(" \t\r");
    return gap[last] == '\n' ? last : gap.size();
  }

  void appendIntoEmpty(std::string& out, std::uint32_t element, const XmlNode& after) {
    if (after.children.empty()) {
      return;
    }
    out.resize(out.find_last_not_of(" \t\r\n", out.size() - 3) + 1);  // without the "/>"
    out += '>';
    const std::string indent = indentAt(bytes_, elements_[element].begin);
    for (const XmlNode& child : after.children) {
      appendNew(out, child, indent + "  ");
    }
    out += "\n" + indent + "</" + after.name + ">";
  }

  void add(std::string& out, const ChildrenPlan& plan, std::size_t behind, const std::string& indent) {
    if (const auto added = plan.added.find(behind); added != plan.added.end()) {
      for (const XmlNode* node : added->second) {
        appendNew(out, *node, indent);
      }
    }
  }

  /// On a line of its own; what stood elsewhere in the file comes as it was written there.
  void appendNew(std::string& out, const XmlNode& node, const std::string& indent) {
    out += "\n" + indent;
    const auto* const small = std::get_if<const SmallObject*>(&node.source);
    const auto old = small == nullptr ? smallObjects().end() : smallObjects().find((*small)->id.value);
    if (old == smallObjects().end() || old->second.before == nullptr) {
      append(out, node, indent);
      return;
    }
    XmlNode before = node;
    before.source = old->second.before;
    XmlNode after = node;
    std::string text;
    merge(text, old->second.element, before, after);
    out += reindented(text, indentAt(bytes_, elements_[old->second.element].begin), indent);
  }

  struct OldSmallObject {
    std::uint32_t element = 0;
    const SmallObject* before = nullptr;
  };

  /// Those of the file by id, for the ones that move. Made when the first is asked for.
  const std::unordered_map<std::string, OldSmallObject>& smallObjects() {
    if (!small_objects_) {
      small_objects_.emplace();
      for (std::uint32_t i = 0; i < elements_.size(); ++i) {
        if (tagName(tag(i)) == "smallObject") {
          for (const LaidAttribute& attribute : attributesOfTag(tag(i))) {
            if (attribute.name == "id") {
              (*small_objects_)[std::string(tag(i).substr(attribute.value_begin, attribute.value_end - attribute.value_begin))] = {i,
                                                                                                                                   nullptr};
            }
          }
        }
      }
      const auto note = [&](const SmallObject& small) { (*small_objects_)[small.id.value].before = &small; };
      for (const Room& room : before_home_.rooms) {
        for (const LargeObject& object : room.objects) {
          std::for_each(object.small_objects.begin(), object.small_objects.end(), note);
        }
        std::for_each(room.small_objects.begin(), room.small_objects.end(), note);
      }
    }
    return *small_objects_;
  }

  [[nodiscard]] ChildrenPlan planFor(const std::vector<std::uint32_t>& children, const XmlNode& before, const XmlNode& after) const {
    ChildrenPlan plan{std::vector<const XmlNode*>(children.size()), std::vector<const XmlNode*>(children.size()), {}};
    std::vector<std::string_view> names;  // in the order that the schema may ask for
    for (const XmlNode* parent : {&after, &before}) {
      for (const XmlNode& child : parent->children) {
        if (std::find(names.begin(), names.end(), listOf(child.name)) == names.end()) {
          names.push_back(listOf(child.name));
        }
      }
    }
    std::vector<std::size_t> rank_of_child;
    rank_of_child.reserve(children.size());
    for (const std::uint32_t child : children) {
      rank_of_child.push_back(static_cast<std::size_t>(std::find(names.begin(), names.end(), listOf(tagName(tag(child)))) - names.begin()));
    }
    for (std::size_t rank = 0; rank < names.size(); ++rank) {
      planName({names[rank], rank, rank_of_child}, before, after, plan);
    }
    return plan;
  }

  struct NamedChildren {
    std::string_view name;
    std::size_t rank;
    const std::vector<std::size_t>& rank_of_child;
  };

  static std::vector<const XmlNode*> named(const XmlNode& node, std::string_view name) {
    std::vector<const XmlNode*> children;
    for (const XmlNode& child : node.children) {
      if (listOf(child.name) == name) {
        children.push_back(&child);
      }
    }
    return children;
  }

  /// Which of the new ones is which of the old ones: by id, those without by position.
  static std::vector<std::size_t> oldOnes(const std::vector<const XmlNode*>& before, const std::vector<const XmlNode*>& after) {
    std::unordered_map<std::string_view, std::size_t> old_of_id;
    for (std::size_t i = 0; i < before.size(); ++i) {
      old_of_id.emplace(before[i]->id, i);
    }
    std::vector<std::size_t> old(after.size(), kNone);
    for (std::size_t i = 0; i < after.size(); ++i) {
      if (after[i]->id.empty()) {
        old[i] = i < before.size() ? i : kNone;
      } else if (const auto found = old_of_id.find(after[i]->id); found != old_of_id.end()) {
        old[i] = found->second;
      }
    }
    return old;
  }

  static void planName(const NamedChildren& children, const XmlNode& before, const XmlNode& after, ChildrenPlan& plan) {
    const std::vector<const XmlNode*> old = named(before, children.name);
    const std::vector<const XmlNode*> wanted = named(after, children.name);
    std::vector<std::size_t> places;
    std::size_t behind = kNone;  // where new ones go if none of this name is there: behind what the schema has before them
    for (std::size_t i = 0; i < children.rank_of_child.size(); ++i) {
      if (children.rank_of_child[i] == children.rank) {
        places.push_back(i);
      }
      if (children.rank_of_child[i] < children.rank) {
        behind = i;
      }
    }
    OIKOS_CHECK(places.size() == old.size());
    for (std::size_t i = 0; i < old.size(); ++i) {
      plan.before[places[i]] = old[i];
    }
    const std::vector<std::size_t> old_of_wanted = oldOnes(old, wanted);
    const std::vector<bool> stays = longestIncreasing(old_of_wanted);
    if (!places.empty()) {
      behind = places.front() == 0 ? kNone : places.front() - 1;
    }
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (stays[i]) {
        behind = places[old_of_wanted[i]];
        plan.after[behind] = wanted[i];
      } else {
        plan.added[behind].push_back(wanted[i]);
      }
    }
  }

  std::string_view bytes_;
  std::vector<LaidElement> elements_;
  const Home& before_home_;
  const Home& after_home_;
  std::optional<std::unordered_map<std::string, OldSmallObject>> small_objects_;
};

/// Throws unless the text reads as the home.
void verify(const std::string& text, const Home& home, const std::string& where) {
  const HomeReading reading = readHomeText(text, where);
  for (const Finding& finding : reading.findings) {
    if (finding.severity == Severity::kError) {
      throw base::Error(base::ErrorCode::kInput,
                        "would not be valid, so the old one was kept: " + finding.element + ": " + finding.found +
                            (finding.expected.empty() ? "" : "; expected " + finding.expected),
                        where);
    }
  }
  OIKOS_CHECK(reading.complete);
  // Some angles have no text in degrees that gives the same bits; then it is the text that must not change any more.
  OIKOS_CHECK(reading.home == home || spliceXml(text, reading.home, home) == text);
}

}  // namespace

std::string toXml(const Home& home) {
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  append(out, nodeOf(home, {}), "");
  return out + "\n";
}

std::string spliceXml(std::string_view bytes, const Home& before, const Home& after) {
  return Splicer(bytes, before, after).run();
}

std::string spliceVerified(std::string_view bytes, const Home& before, const Home& after, const std::string& where) {
  std::string text = spliceXml(bytes, before, after);
  verify(text, after, where);
  return text;
}

}  // namespace oikos::semantic
