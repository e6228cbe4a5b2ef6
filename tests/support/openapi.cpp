// SPDX-License-Identifier: Apache-2.0
#include "tests/support/openapi.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/base/rfc3339.h"

namespace oikos::test {

namespace {

using Json = nlohmann::json;
using Faults = std::vector<std::string>;

/// A plain scalar by the core schema of YAML 1.2; a quoted one is a text.
Json scalarOf(const YAML::Node& node) {
  const std::string& text = node.Scalar();
  if (node.Tag() == "!") {
    return text;
  }
  const Json value = Json::parse(text, nullptr, false);
  return value.is_discarded() || value.is_structured() || value.is_string() ? Json(text) : value;
}

Json jsonOf(const YAML::Node& node) {
  Json json;
  switch (node.Type()) {
    case YAML::NodeType::Scalar:
      return scalarOf(node);
    case YAML::NodeType::Sequence:
      json = Json::array();
      for (const YAML::Node& item : node) {
        json.push_back(jsonOf(item));
      }
      return json;
    case YAML::NodeType::Map:
      json = Json::object();
      for (const auto& member : node) {
        json[member.first.Scalar()] = jsonOf(member.second);
      }
      return json;
    default:
      return json;
  }
}

class Check {
 public:
  explicit Check(const OpenApi& description) : description_(description) {}

  Faults faultsOf(const Json& value, const Json& schema, const std::string& path) {
    Faults faults;
    const bool is_null = value.is_null() && schema.value("nullable", false);
    for (const auto& [keyword, rule] : schema.items()) {
      const auto rule_of = kRules.find(keyword);
      if (rule_of == kRules.end()) {
        if (!kRemarks.contains(keyword)) {
          faults.push_back(path + ": the schema says '" + keyword + "', which is not known here");
        }
      } else if (!is_null || keyword == "enum") {
        const Faults more = (this->*rule_of->second)(value, rule, schema, path);
        faults.insert(faults.end(), more.begin(), more.end());
      }
    }
    return faults;
  }

 private:
  using Rule = Faults (Check::*)(const Json& value, const Json& rule, const Json& schema, const std::string& path);

  Faults type(const Json& value, const Json& rule, const Json&, const std::string& path) {
    static const std::map<std::string, bool (Json::*)() const noexcept> kTypes{
        {"object", &Json::is_object}, {"array", &Json::is_array},     {"string", &Json::is_string},
        {"number", &Json::is_number}, {"boolean", &Json::is_boolean}, {"integer", &Json::is_number_integer}};
    return (value.*kTypes.at(rule))() ? Faults() : Faults{path + ": " + value.dump() + " is no " + rule.get<std::string>()};
  }

  Faults isOneOf(const Json& value, const Json& rule, const Json&, const std::string& path) {
    return std::find(rule.begin(), rule.end(), value) != rule.end() ? Faults()
                                                                    : Faults{path + ": " + value.dump() + " is none of " + rule.dump()};
  }

  Faults format(const Json& value, const Json& rule, const Json&, const std::string& path) {
    const bool right = rule == "date-time" && value.is_string() && base::parseRfc3339Ns(value.get<std::string>());
    return right ? Faults() : Faults{path + ": " + value.dump() + " is no " + rule.get<std::string>()};
  }

  Faults minimum(const Json& value, const Json& rule, const Json&, const std::string& path) {
    return value >= rule ? Faults() : Faults{path + ": " + value.dump() + " is less than " + rule.dump()};
  }
  Faults maximum(const Json& value, const Json& rule, const Json&, const std::string& path) {
    return value <= rule ? Faults() : Faults{path + ": " + value.dump() + " is more than " + rule.dump()};
  }
  Faults leastItems(const Json& value, const Json& rule, const Json&, const std::string& path) {
    return value.size() >= rule.get<std::size_t>() ? Faults() : Faults{path + ": fewer items than " + rule.dump()};
  }
  Faults mostItems(const Json& value, const Json& rule, const Json&, const std::string& path) {
    return value.size() <= rule.get<std::size_t>() ? Faults() : Faults{path + ": more items than " + rule.dump()};
  }

  Faults items(const Json& value, const Json& rule, const Json&, const std::string& path) {
    Faults faults;
    for (std::size_t i = 0; value.is_array() && i < value.size(); ++i) {
      const Faults more = faultsOf(value[i], rule, path + "[" + std::to_string(i) + "]");
      faults.insert(faults.end(), more.begin(), more.end());
    }
    return faults;
  }

  Faults required(const Json& value, const Json& rule, const Json&, const std::string& path) {
    Faults faults;
    for (const Json& name : rule) {
      if (!value.contains(name.get<std::string>())) {
        faults.push_back(path + ": no '" + name.get<std::string>() + "'");
      }
    }
    return faults;
  }

  Faults properties(const Json& value, const Json& rule, const Json& schema, const std::string& path) {
    Faults faults;
    for (const auto& [name, member] : value.items()) {
      if (!value.is_object() || (!rule.contains(name) && schema.contains("additionalProperties"))) {
        continue;
      }
      const Faults more =
          rule.contains(name) ? faultsOf(member, rule[name], path + "." + name) : Faults{path + "." + name + ": not described"};
      faults.insert(faults.end(), more.begin(), more.end());
    }
    return faults;
  }

  Faults otherProperties(const Json& value, const Json& rule, const Json& schema, const std::string& path) {
    Faults faults;
    for (const auto& [name, member] : value.items()) {
      if (value.is_object() && !schema.value("properties", Json::object()).contains(name)) {
        const Faults more = faultsOf(member, rule, path + "." + name);
        faults.insert(faults.end(), more.begin(), more.end());
      }
    }
    return faults;
  }

  Faults reference(const Json& value, const Json& rule, const Json&, const std::string& path) {
    const auto target = rule.get<std::string>();
    return faultsOf(value, description_.document().at(Json::json_pointer(target.substr(target.find('#') + 1))), path);
  }

  Faults allOf(const Json& value, const Json& rule, const Json&, const std::string& path) {
    Faults faults;
    for (const Json& schema : rule) {
      const Faults more = faultsOf(value, schema, path);
      faults.insert(faults.end(), more.begin(), more.end());
    }
    return faults;
  }

  Faults oneOf(const Json& value, const Json& rule, const Json&, const std::string& path) {
    std::string reasons;
    int fitting = 0;
    for (const Json& schema : rule) {
      const Faults faults = faultsOf(value, schema, path);
      fitting += faults.empty() ? 1 : 0;
      reasons += faults.empty() ? "" : "\n  " + faults.front();
    }
    return fitting == 1 ? Faults() : Faults{path + ": fits " + std::to_string(fitting) + " of the schemas instead of one" + reasons};
  }

  static const std::map<std::string, Rule> kRules;
  static const std::set<std::string> kRemarks;

  const OpenApi& description_;
};

const std::map<std::string, Check::Rule> Check::kRules{{"type", &Check::type},
                                                       {"enum", &Check::isOneOf},
                                                       {"format", &Check::format},
                                                       {"minimum", &Check::minimum},
                                                       {"maximum", &Check::maximum},
                                                       {"minItems", &Check::leastItems},
                                                       {"maxItems", &Check::mostItems},
                                                       {"items", &Check::items},
                                                       {"required", &Check::required},
                                                       {"properties", &Check::properties},
                                                       {"additionalProperties", &Check::otherProperties},
                                                       {"$ref", &Check::reference},
                                                       {"allOf", &Check::allOf},
                                                       {"oneOf", &Check::oneOf}};
const std::set<std::string> Check::kRemarks{"description", "example", "default", "nullable", "readOnly", "writeOnly"};

}  // namespace

OpenApi::OpenApi(const std::filesystem::path& file) : document_(jsonOf(YAML::LoadFile(file.string()))) {}

const Json& OpenApi::schema(const std::string& name) const {
  return document_.at("components").at("schemas").at(name);
}

std::vector<std::string> OpenApi::faultsOf(const Json& value, const Json& schema) const {
  return Check(*this).faultsOf(value, schema, "$");
}

}  // namespace oikos::test
