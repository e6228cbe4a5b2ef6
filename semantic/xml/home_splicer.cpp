// SPDX-License-Identifier: Apache-2.0
// The changes of a home put into its file: walks the file's elements along with both homes, and copies what is the same.
#include <algorithm>
#include <optional>
#include <unordered_map>
#include <variant>
#include <vector>

#include "semantic/xml/children_plan.h"
#include "semantic/xml/home_nodes.h"
#include "semantic/xml/home_writer.h"
#include "semantic/xml/node_text.h"
#include "semantic/xml/tag_merge.h"
#include "semantic/xml/xml_layout.h"

namespace oikos::semantic {

namespace {

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

  [[nodiscard]] std::vector<std::string_view> namesOf(const std::vector<std::uint32_t>& elements) const {
    std::vector<std::string_view> names;
    names.reserve(elements.size());
    for (const std::uint32_t element : elements) {
      names.push_back(tagName(tag(element)));
    }
    return names;
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
      appendElement(out, after, indentAt(bytes_, laid.begin));
      return;
    }
    appendMergedTag(out, tag(element), before, after);
    mergeChildren(out, element, before, after);
  }

  void mergeChildren(std::string& out, std::uint32_t element, XmlNode& before, XmlNode& after) {
    const LaidElement& laid = elements_[element];
    if (isEmptyTag(tag(element))) {
      appendIntoEmpty(out, element, after);
      return;
    }
    const std::vector<std::uint32_t> children = childrenOf(element);
    const ChildrenPlan plan = planChildren(namesOf(children), before, after);
    const std::string indent = children.empty() ? indentAt(bytes_, laid.begin) + "  " : indentAt(bytes_, elements_[children.front()].begin);
    add(out, plan, ChildrenPlan::kBeforeFirst, indent);
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
      appendElement(out, node, indent);
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
      noteElements(*small_objects_);
      noteObjects(*small_objects_);
    }
    return *small_objects_;
  }

  void noteElements(std::unordered_map<std::string, OldSmallObject>& by_id) const {
    for (std::uint32_t i = 0; i < elements_.size(); ++i) {
      const std::string_view text = tag(i);
      if (tagName(text) != "smallObject") {
        continue;
      }
      for (const LaidAttribute& attribute : attributesOfTag(text)) {
        if (attribute.name == "id") {
          by_id[std::string(text.substr(attribute.value_begin, attribute.value_end - attribute.value_begin))] = {i, nullptr};
        }
      }
    }
  }

  void noteObjects(std::unordered_map<std::string, OldSmallObject>& by_id) const {
    const auto note = [&](const SmallObject& small) { by_id[small.id.value].before = &small; };
    for (const Room& room : before_home_.rooms) {
      for (const LargeObject& object : room.objects) {
        std::for_each(object.small_objects.begin(), object.small_objects.end(), note);
      }
      std::for_each(room.small_objects.begin(), room.small_objects.end(), note);
    }
  }

  std::string_view bytes_;
  std::vector<LaidElement> elements_;
  const Home& before_home_;
  const Home& after_home_;
  std::optional<std::unordered_map<std::string, OldSmallObject>> small_objects_;
};

}  // namespace

std::string spliceXml(std::string_view bytes, const Home& before, const Home& after) {
  return Splicer(bytes, before, after).run();
}

}  // namespace oikos::semantic
