// SPDX-License-Identifier: Apache-2.0
// A description in OpenAPI 3.0, and whether a document is as one of its schemas says.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace oikos::test {

/// Knows of schemas what ours use: type, nullable, enum, format date-time, minimum, maximum, items, minItems, maxItems, properties,
/// required, additionalProperties, oneOf, allOf and $ref within the file. Any other keyword that says what is allowed is a fault of the
/// schema.
class OpenApi {
 public:
  /// Reads YAML. Throws what yaml-cpp throws.
  explicit OpenApi(const std::filesystem::path& file);

  [[nodiscard]] const nlohmann::json& document() const { return document_; }
  /// By its name under components/schemas. Throws if there is none.
  [[nodiscard]] const nlohmann::json& schema(const std::string& name) const;

  /// Where the document differs from the schema, each with its path; none: nowhere. Stricter than OpenAPI: a member that the schema does
  /// not describe is a fault, too.
  [[nodiscard]] std::vector<std::string> faultsOf(const nlohmann::json& value, const nlohmann::json& schema) const;

 private:
  nlohmann::json document_;
};

}  // namespace oikos::test
