// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/base/enum_table.h"
#include "core/base/error.h"

/// Parameters as plain structs that name their fields once:
///
///     struct VolumeConfig {
///       double resolution_m = 0.05;  ///< edge of a voxel
///       SensorConfig sensor;         ///< a table of its own: `[volume.sensor]`
///
///       template <class Visitor>
///       void visit(Visitor&& visitor) {
///         visitor("resolution_m", resolution_m);
///         visitor("sensor", sensor);
///       }
///       [[nodiscard]] std::vector<std::string> validate() const {
///         return base::ConfigRules().greater("resolution_m", resolution_m, 0.0).messages();
///       }
///     };
///
/// `validate()` is optional and looks at its own fields only; nested structs are validated by `validateConfig`, which also
/// puts their names in front. Field types: bool, int, int64_t, double, string, vector of double or string, enums with a table.
namespace oikos::base {

/// An enum field with its type erased.
struct EnumField {
  std::function<std::string()> get;
  std::function<bool(const std::string&)> set;  ///< false: no such name
  std::vector<std::string> names;
};

using FieldTarget =
    std::variant<bool*, int*, std::int64_t*, double*, std::string*, std::vector<double>*, std::vector<std::string>*, EnumField>;

/// One parameter. Points into the struct that it was listed from.
struct ConfigField {
  std::string key;  ///< with the names of the tables around it: `volume.sensor.max_range_m`
  FieldTarget target;
};

template <class T>
concept VisitableConfig = requires(T config) {
  config.visit([](auto&&...) {});
};

/// A visitor that lists the fields of a config struct, nested ones included, in the struct's order.
class FieldLister {
 public:
  explicit FieldLister(std::vector<ConfigField>& fields, std::string prefix = {}) : fields_(&fields), prefix_(std::move(prefix)) {}

  template <class Value>
  void operator()(std::string_view name, Value& value) {
    const std::string key = prefix_ + std::string(name);
    if constexpr (VisitableConfig<Value>) {
      value.visit(FieldLister(*fields_, key + "."));
    } else if constexpr (NamedEnum<Value>) {
      fields_->push_back({key, eraseType(value)});
    } else {
      static_assert(std::is_constructible_v<FieldTarget, Value*>, "a config field of this type is not supported");
      fields_->push_back({key, &value});
    }
  }

 private:
  template <class Enum>
  static EnumField eraseType(Enum& value) {
    return {[&value] { return std::string(toString(value)); },
            [&value](const std::string& name) {
              const auto found = findEnum<Enum>(name);
              value = found.value_or(value);
              return found.has_value();
            },
            enumNames<Enum>()};
  }

  std::vector<ConfigField>* fields_;
  std::string prefix_;
};

/// A visitor that gathers the messages of nested `validate()`s, each with its table's name in front.
class MessageCollector {
 public:
  explicit MessageCollector(std::vector<std::string>& messages, std::string prefix = {})
      : messages_(&messages), prefix_(std::move(prefix)) {}

  template <class Value>
  void operator()(std::string_view name, Value& value) {
    if constexpr (VisitableConfig<Value>) {
      MessageCollector(*messages_, prefix_ + std::string(name) + ".").collect(value);
    }
  }

  template <class Config>
  void collect(Config& config) {
    if constexpr (requires { config.validate(); }) {
      for (const std::string& message : config.validate()) {
        messages_->push_back(prefix_ + message);
      }
    }
    config.visit(*this);
  }

 private:
  std::vector<std::string>* messages_;
  std::string prefix_;
};

/// One parameter from the command line, which wins over the file.
struct Setting {
  std::string key;
  std::string value;   ///< as TOML; the quotes of a string may be left out
  std::string origin;  ///< the option that it came from, for messages: `--resolution`
};

/// Splits `KEY=VALUE`. Throws Error{kUsage}.
[[nodiscard]] Setting parseSetting(const std::string& text, const std::string& origin = "--set");

/// Where a value came from.
struct ConfigOrigin {
  std::string where;  ///< `map.toml:12` or `--set`
  ErrorCode code = ErrorCode::kInput;
};
using ConfigOrigins = std::map<std::string, ConfigOrigin>;  ///< by key

/// What stands above the defaults, weakest first: the file (none if empty), then the settings in order.
struct ConfigLayers {
  std::filesystem::path file;
  std::vector<Setting> settings;
};

/// Fills the fields. Throws Error: for the file kInput with `FILE:LINE`, for a setting kUsage with its origin.
ConfigOrigins assignFields(const std::vector<ConfigField>& fields, const ConfigLayers& layers);

/// Throws the first message as an Error of the layer that its key came from.
void throwIfInvalid(const std::vector<std::string>& messages, const ConfigOrigins& origins);

[[nodiscard]] std::string writeFields(const std::vector<ConfigField>& fields);

template <VisitableConfig Config>
[[nodiscard]] std::vector<ConfigField> listFields(Config& config) {
  std::vector<ConfigField> fields;
  config.visit(FieldLister(fields));
  return fields;
}

/// All broken rules, as `registration.max_correspondence_m = -1: must be > 0`; empty if the configuration is good.
template <VisitableConfig Config>
[[nodiscard]] std::vector<std::string> validateConfig(Config config) {
  std::vector<std::string> messages;
  MessageCollector(messages).collect(config);
  return messages;
}

/// Defaults, then the file, then the settings; validated. Throws Error that names file and line (or option), key, value found
/// and what would be right; an unknown key is answered with the nearest known one.
template <VisitableConfig Config>
[[nodiscard]] Config loadConfig(const ConfigLayers& layers) {
  Config config;
  const ConfigOrigins origins = assignFields(listFields(config), layers);
  throwIfInvalid(validateConfig(config), origins);
  return config;
}

/// The effective configuration as TOML: every field in the struct's order, numbers exact and the same in every locale.
/// `loadConfig` of it gives the same configuration.
template <VisitableConfig Config>
[[nodiscard]] std::string writeConfig(Config config) {
  return writeFields(listFields(config));
}

}  // namespace oikos::base
