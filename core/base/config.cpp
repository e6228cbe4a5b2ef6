// SPDX-License-Identifier: Apache-2.0
#include "core/base/config.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>
#include <optional>
#include <sstream>

#include "core/base/nearest_name.h"
#include "core/base/number_text.h"
#include "core/base/read_file.h"

namespace oikos::base {

namespace {

/// A value of the file, or a table with nothing in it.
struct Leaf {
  std::string key;
  const toml::node* node;
};

void collectLeaves(const toml::table& table, const std::string& prefix, std::vector<Leaf>& leaves) {
  for (const auto& [name, node] : table) {
    const std::string key = prefix + std::string(name.str());
    const toml::table* const inner = node.as_table();
    if (inner != nullptr && !inner->empty()) {
      collectLeaves(*inner, key + ".", leaves);
    } else {
      leaves.push_back({key, &node});
    }
  }
}

/// In the order of the file, so that its first mistake is the one reported.
std::vector<Leaf> leavesInOrder(const toml::table& table) {
  std::vector<Leaf> leaves;
  collectLeaves(table, "", leaves);
  std::stable_sort(leaves.begin(), leaves.end(),
                   [](const Leaf& a, const Leaf& b) { return a.node->source().begin < b.node->source().begin; });
  return leaves;
}

toml::table parseToml(const std::string& text, const std::string& file) {
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw Error(ErrorCode::kInput, "is not TOML: " + std::string(error.description()),
                file + ":" + std::to_string(error.source().begin.line));
  }
}

/// Writes a TOML value into a field. Each returns what would be right, or nothing if the value was taken.
class Assignment {
 public:
  explicit Assignment(const toml::node& node) : node_(&node) {}

  std::optional<std::string> operator()(bool* target) const { return take(node_->value_exact<bool>(), target, "true or false"); }
  std::optional<std::string> operator()(std::int64_t* target) const {
    return take(node_->value_exact<std::int64_t>(), target, "a whole number");
  }
  std::optional<std::string> operator()(int* target) const {
    auto number = node_->value_exact<std::int64_t>();
    if (number && (*number < std::numeric_limits<int>::min() || *number > std::numeric_limits<int>::max())) {
      number.reset();
    }
    return take(number, target, "a whole number of at most 31 bits");
  }
  std::optional<std::string> operator()(double* target) const { return take(finiteNumber(*node_), target, "a finite number"); }
  std::optional<std::string> operator()(std::string* target) const { return take(node_->value_exact<std::string>(), target, "a string"); }
  std::optional<std::string> operator()(std::vector<double>* target) const {
    return take(list<double>(finiteNumber), target, "a list of finite numbers");
  }
  std::optional<std::string> operator()(std::vector<std::string>* target) const {
    return take(list<std::string>([](const toml::node& node) { return node.value_exact<std::string>(); }), target, "a list of strings");
  }
  std::optional<std::string> operator()(const EnumField& target) const {
    const auto name = node_->value_exact<std::string>();
    if (name && target.set(*name)) {
      return std::nullopt;
    }
    std::string right = "one of";
    for (const std::string& known : target.names) {
      right += (right.size() == 6 ? " " : ", ") + known;
    }
    return right;
  }

 private:
  template <class Value, class Target>
  static std::optional<std::string> take(const std::optional<Value>& value, Target* target, const char* right) {
    if (!value) {
      return right;
    }
    *target = static_cast<Target>(*value);
    return std::nullopt;
  }

  static std::optional<double> finiteNumber(const toml::node& node) {
    const auto number = node.is_number() ? node.value<double>() : std::nullopt;
    return number && std::isfinite(*number) ? number : std::nullopt;
  }

  template <class Value, class Reader>
  std::optional<std::vector<Value>> list(const Reader& read) const {
    const toml::array* const array = node_->as_array();
    if (array == nullptr) {
      return std::nullopt;
    }
    std::vector<Value> values;
    for (const toml::node& element : *array) {
      const std::optional<Value> value = read(element);
      if (!value) {
        return std::nullopt;
      }
      values.push_back(*value);
    }
    return values;
  }

  const toml::node* node_;
};

/// A value as it could stand in the file, on one line.
std::string textOf(const toml::node& node) {
  if (node.is_table()) {
    return "{…}";
  }
  std::ostringstream text;
  text.imbue(std::locale::classic());
  if (const toml::array* const array = node.as_array()) {
    for (const toml::node& element : *array) {
      text << (text.tellp() == 0 ? "" : ", ") << textOf(element);
    }
    return "[" + text.str() + "]";
  }
  node.visit([&text](const auto& value) { text << value; });
  return text.str();
}

const ConfigField& getField(const std::vector<ConfigField>& fields, const std::string& key, const ConfigOrigin& origin) {
  const auto found = std::find_if(fields.begin(), fields.end(), [&key](const ConfigField& field) { return field.key == key; });
  if (found != fields.end()) {
    return *found;
  }
  std::vector<std::string> keys;
  for (const ConfigField& field : fields) {
    if (field.key.starts_with(key + ".")) {
      throw Error(origin.code, "key '" + key + "' is a table, a value was given; a value in it is '" + field.key + "'", origin.where);
    }
    keys.push_back(field.key);
  }
  throw Error(origin.code, "unknown key '" + key + "'; the nearest known key is '" + nearestName(key, keys) + "'", origin.where);
}

void assign(const ConfigField& field, const toml::node& node, const ConfigOrigin& origin) {
  if (const auto right = std::visit(Assignment(node), field.target)) {
    throw Error(origin.code, field.key + " = " + textOf(node) + ": must be " + *right, origin.where);
  }
}

bool isEmptyKnownTable(const std::vector<ConfigField>& fields, const Leaf& leaf) {
  return leaf.node->is_table() &&
         std::any_of(fields.begin(), fields.end(), [&leaf](const ConfigField& field) { return field.key.starts_with(leaf.key + "."); });
}

void assignFile(const std::vector<ConfigField>& fields, const std::filesystem::path& file, ConfigOrigins& origins) {
  const toml::table table = parseToml(readFile(file), file.string());
  for (const Leaf& leaf : leavesInOrder(table)) {
    if (isEmptyKnownTable(fields, leaf)) {
      continue;
    }
    const ConfigOrigin origin{file.string() + ":" + std::to_string(leaf.node->source().begin.line), ErrorCode::kInput};
    assign(getField(fields, leaf.key, origin), *leaf.node, origin);
    origins[leaf.key] = origin;
  }
}

/// The setting's value as a node under the name "value".
toml::table parseSettingValue(const Setting& setting, const ConfigField& field, const ConfigOrigin& origin) {
  const bool is_text = std::holds_alternative<std::string*>(field.target) || std::holds_alternative<EnumField>(field.target);
  const bool is_quoted = setting.value.starts_with('"') || setting.value.starts_with('\'');
  if (is_text && !is_quoted) {
    return toml::table{{"value", setting.value}};
  }
  const Error no_value(origin.code, setting.key + " = " + setting.value + ": is not a TOML value", origin.where);
  try {
    const toml::table table = toml::parse("value = " + setting.value);
    return table.size() == 1 ? table : throw no_value;  // a line break in the value would begin another key
  } catch (const toml::parse_error&) {
    throw no_value;
  }
}

void assignSetting(const std::vector<ConfigField>& fields, const Setting& setting, ConfigOrigins& origins) {
  const ConfigOrigin origin{setting.origin, ErrorCode::kUsage};
  const ConfigField& field = getField(fields, setting.key, origin);
  const toml::table table = parseSettingValue(setting, field, origin);
  assign(field, *table.get("value"), origin);
  origins[setting.key] = origin;
}

/// Writes a field's value as TOML.
struct ValueText {
  std::string operator()(const bool* value) const { return *value ? "true" : "false"; }
  std::string operator()(const int* value) const { return toText(static_cast<std::int64_t>(*value)); }
  std::string operator()(const std::int64_t* value) const { return toText(*value); }
  std::string operator()(const double* value) const { return number(*value); }
  std::string operator()(const std::string* value) const { return quoted(*value); }
  std::string operator()(const std::vector<double>* values) const { return list(*values, number); }
  std::string operator()(const std::vector<std::string>* values) const { return list(*values, quoted); }
  std::string operator()(const EnumField& value) const { return quoted(value.get()); }

  static std::string number(double value) {
    const std::string text = toText(value);
    const bool reads_as_integer = text.find_first_not_of("-0123456789") == std::string::npos;
    return reads_as_integer ? text + ".0" : text;
  }
  static std::string quoted(const std::string& value) {
    static constexpr std::string_view kHex = "0123456789abcdef";
    std::string text = "\"";
    for (const char c : value) {
      const auto code = static_cast<unsigned char>(c);
      if (c == '"' || c == '\\') {
        text += {'\\', c};
      } else if (code < 0x20 || code == 0x7f) {
        text += std::string("\\u00") + kHex[code >> 4] + kHex[code & 0xf];
      } else {
        text += c;
      }
    }
    return text + '"';
  }
  template <class Value, class Writer>
  static std::string list(const std::vector<Value>& values, const Writer& write) {
    std::string text = "[";
    for (const Value& value : values) {
      text += (text.size() == 1 ? "" : ", ") + write(value);
    }
    return text + "]";
  }
};

std::string tableOf(const std::string& key) {
  const std::size_t dot = key.rfind('.');
  return dot == std::string::npos ? "" : key.substr(0, dot);
}

/// The tables in order of appearance, the root first: in TOML nothing can be added to it after a table's header.
std::vector<std::string> tablesInOrder(const std::vector<ConfigField>& fields) {
  std::vector<std::string> tables = {""};
  for (const ConfigField& field : fields) {
    const std::string table = tableOf(field.key);
    if (std::find(tables.begin(), tables.end(), table) == tables.end()) {
      tables.push_back(table);
    }
  }
  return tables;
}

}  // namespace

Setting parseSetting(const std::string& text, const std::string& origin) {
  const std::size_t equals = text.find('=');
  const auto trimmed = [](std::string_view part) {
    const std::size_t first = part.find_first_not_of(' ');
    return first == std::string_view::npos ? std::string() : std::string(part.substr(first, part.find_last_not_of(' ') - first + 1));
  };
  if (equals == std::string::npos || trimmed(text.substr(0, equals)).empty()) {
    throw Error(ErrorCode::kUsage, "'" + text + "': must be KEY=VALUE", origin);
  }
  return {trimmed(text.substr(0, equals)), trimmed(text.substr(equals + 1)), origin};
}

ConfigOrigins assignFields(const std::vector<ConfigField>& fields, const ConfigLayers& layers) {
  ConfigOrigins origins;
  if (!layers.file.empty()) {
    assignFile(fields, layers.file, origins);
  }
  for (const Setting& setting : layers.settings) {
    assignSetting(fields, setting, origins);
  }
  return origins;
}

void throwIfInvalid(const std::vector<std::string>& messages, const ConfigOrigins& origins) {
  if (messages.empty()) {
    return;
  }
  const std::string& message = messages.front();
  const auto origin = origins.find(message.substr(0, message.find(" = ")));
  if (origin != origins.end()) {
    throw Error(origin->second.code, message, origin->second.where);
  }
  // A rule between two keys may name the one that was left at its default.
  OIKOS_CHECK(!origins.empty());
  throw Error(ErrorCode::kInput, message, "configuration");
}

std::string writeFields(const std::vector<ConfigField>& fields) {
  std::string text;
  for (const std::string& table : tablesInOrder(fields)) {
    if (!table.empty()) {
      text += (text.empty() ? "[" : "\n[") + table + "]\n";
    }
    for (const ConfigField& field : fields) {
      if (tableOf(field.key) == table) {
        const std::string name = table.empty() ? field.key : field.key.substr(table.size() + 1);
        text += name + " = " + std::visit(ValueText{}, field.target) + "\n";
      }
    }
  }
  return text;
}

}  // namespace oikos::base
