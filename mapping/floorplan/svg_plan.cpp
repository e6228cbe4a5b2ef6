// SPDX-License-Identifier: Apache-2.0
#include <libxml/parser.h>
#include <libxml/tree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/base/error.h"
#include "core/base/number_text.h"
#include "mapping/floorplan/plan_readers.h"

namespace oikos::mapping {

namespace {

struct FreeDocument {
  void operator()(xmlDoc* document) const { xmlFreeDoc(document); }
};

std::string_view nameOf(const xmlNode* node) {
  return reinterpret_cast<const char*>(node->name);
}

std::optional<std::string> findAttribute(const xmlNode* node, std::string_view name) {
  for (const xmlAttr* attribute = node->properties; attribute != nullptr; attribute = attribute->next) {
    if (reinterpret_cast<const char*>(attribute->name) == name && attribute->children != nullptr) {
      return reinterpret_cast<const char*>(attribute->children->content);
    }
  }
  return std::nullopt;
}

template <std::size_t kCount>
bool isOneOf(std::string_view name, const std::array<std::string_view, kCount>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// What holds shapes, and what cannot be left out without losing lines; of the rest, nothing is drawn where it stands.
constexpr std::array<std::string_view, 4> kGroups = {"svg", "g", "a", "switch"};
constexpr std::array<std::string_view, 2> kNotRead = {"use", "image"};

class SvgReader {
 public:
  SvgReader(const std::filesystem::path& file, const std::string& layer) : file_(file), layer_(layer) {}

  Drawing read(const std::string& text) {
    xmlResetLastError();
    const std::unique_ptr<xmlDoc, FreeDocument> document(xmlReadMemory(text.data(), static_cast<int>(text.size()), nullptr, nullptr,
                                                                       XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING));
    if (document == nullptr) {
      refuseXml();
    }
    if (document->intSubset != nullptr && document->intSubset->entities != nullptr) {
      refusePlan({file_, 1}, "defines entities; save it as plain SVG");
    }
    const xmlNode* root = xmlDocGetRootElement(document.get());
    if (root == nullptr || nameOf(root) != "svg") {
      refusePlan({file_, root == nullptr ? 1 : static_cast<int>(xmlGetLineNo(root))}, "is no SVG: its root element must be svg");
    }
    Eigen::Affine2d y_up = Eigen::Affine2d::Identity();
    y_up.linear().diagonal() << 1.0, -1.0;
    readGroup(root, y_up, layer_.empty());
    return std::move(drawing_);
  }

 private:
  [[noreturn]] void refuseXml() const {
    const xmlError* error = xmlGetLastError();
    std::string what = error != nullptr && error->message != nullptr ? error->message : "is no XML";
    while (!what.empty() && (what.back() == '\n' || what.back() == ' ')) {
      what.pop_back();
    }
    refusePlan({file_, error != nullptr ? error->line : 1}, what);
  }

  // NOLINTNEXTLINE(misc-no-recursion): libxml2 limits the depth to 256.
  void readGroup(const xmlNode* group, const Eigen::Affine2d& T_plan_group, bool chosen) {
    for (const xmlNode* node = group->children; node != nullptr; node = node->next) {
      if (node->type == XML_ELEMENT_NODE) {
        readNode(node, T_plan_group, chosen);
      }
    }
  }

  // NOLINTNEXTLINE(misc-no-recursion): as above.
  void readNode(const xmlNode* node, const Eigen::Affine2d& T_plan_group, bool chosen) {
    const PlanSource source{file_, static_cast<int>(xmlGetLineNo(node))};
    const std::string_view name = nameOf(node);
    if (isHidden(node)) {
      return;
    }
    Eigen::Affine2d T_plan_node = T_plan_group;
    if (const auto transform = findAttribute(node, "transform")) {
      T_plan_node = T_plan_group * parseSvgTransform(*transform, source);
    }
    if (isOneOf(name, kGroups)) {
      if (name == "svg") {
        refusePlan(source, "svg: a drawing within the drawing is not read");
      }
      readGroup(node, T_plan_node, chosen || isLayer(node));
    } else if (chosen) {
      readShape(node, T_plan_node, source);
    }
  }

  [[nodiscard]] bool isLayer(const xmlNode* node) const {
    return findAttribute(node, "id") == layer_ || findAttribute(node, "label") == layer_;
  }

  static bool isHidden(const xmlNode* node) {
    const std::string style = findAttribute(node, "style").value_or("");
    return findAttribute(node, "display") == "none" || style.find("display:none") != std::string::npos;
  }

  void readShape(const xmlNode* node, const Eigen::Affine2d& T_plan_node, const PlanSource& source) {
    const std::string_view name = nameOf(node);
    if (isOneOf(name, kNotRead)) {
      refusePlan(source, std::string(name) + ": is not read; draw what it stands for, or leave it out");
    }
    if (name == "path") {
      for (const Polyline& line : parseSvgPath(findAttribute(node, "d").value_or(""), source)) {
        add(line, T_plan_node);
      }
    } else if (name == "line") {
      add({{number(node, "x1", source), number(node, "y1", source)}, {number(node, "x2", source), number(node, "y2", source)}},
          T_plan_node);
    } else if (name == "polyline" || name == "polygon") {
      readPoints(node, T_plan_node, source);
    } else if (name == "rect") {
      readRect(node, T_plan_node, source);
    } else if (name == "circle" || name == "ellipse") {
      const double r = name == "circle" ? number(node, "r", source) : 0.0;
      const Eigen::Vector2d radii =
          name == "circle" ? Eigen::Vector2d(r, r) : Eigen::Vector2d(number(node, "rx", source), number(node, "ry", source));
      add(arcPoints({number(node, "cx", source), number(node, "cy", source)}, radii, 0.0, 2.0 * std::numbers::pi), T_plan_node);
    }
  }

  void readPoints(const xmlNode* node, const Eigen::Affine2d& T_plan_node, const PlanSource& source) {
    const std::vector<double> numbers = parseSvgNumbers(findAttribute(node, "points").value_or(""), source);
    if (numbers.size() % 2 != 0) {
      refusePlan(source, "points: " + base::toText(static_cast<std::int64_t>(numbers.size())) + " numbers; must be pairs");
    }
    Polyline line;
    for (std::size_t i = 0; i < numbers.size(); i += 2) {
      line.emplace_back(numbers[i], numbers[i + 1]);
    }
    if (nameOf(node) == "polygon" && !line.empty()) {
      line.push_back(line.front());
    }
    add(line, T_plan_node);
  }

  void readRect(const xmlNode* node, const Eigen::Affine2d& T_plan_node, const PlanSource& source) {
    const Eigen::Vector2d a(number(node, "x", source), number(node, "y", source));
    const Eigen::Vector2d size(number(node, "width", source), number(node, "height", source));
    if (!(size.minCoeff() >= 0.0)) {
      refusePlan(source, "rect: width and height must not be negative");
    }
    const Eigen::Vector2d b = a + size;
    add({a, {b.x(), a.y()}, b, {a.x(), b.y()}, a}, T_plan_node);
  }

  /// 0 if it is not given, as SVG has it; in user units.
  static double number(const xmlNode* node, std::string_view name, const PlanSource& source) {
    std::string text = findAttribute(node, name).value_or("0");
    if (text.ends_with("px")) {
      text.resize(text.size() - 2);
    }
    const auto value = base::findNumber(text);
    if (!value || !std::isfinite(*value)) {
      refusePlan(source, std::string(name) + " = \"" + text + "\": must be a number of user units");
    }
    return *value;
  }

  void add(const Polyline& line, const Eigen::Affine2d& T_plan_node) {
    Polyline placed;
    for (const Eigen::Vector2d& point : line) {
      placed.push_back(T_plan_node * point);
    }
    if (placed.size() > 1) {
      drawing_.lines.push_back(std::move(placed));
    }
  }

  const std::filesystem::path& file_;
  const std::string& layer_;
  Drawing drawing_;
};

}  // namespace

Drawing readSvg(const std::string& text, const std::filesystem::path& file, const std::string& layer) {
  return SvgReader(file, layer).read(text);
}

}  // namespace oikos::mapping
