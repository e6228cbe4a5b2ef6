// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/g2o_file.h"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/base/read_file.h"
#include "core/geometry/pose_numbers.h"

namespace oikos::mapping {

namespace {

std::string poseText(const Eigen::Isometry3d& T) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(T.linear()).normalized();
  std::string text;
  for (const double value : {T.translation().x(), T.translation().y(), T.translation().z(), q.x(), q.y(), q.z(), q.w()}) {
    text += ' ' + base::toText(value);
  }
  return text;
}

/// g2o's rotation error is the quaternion's vector part, half the angle: its information is four times that of the angle.
double informationScale(int row, int column) {
  return (row >= 3 ? 2.0 : 1.0) * (column >= 3 ? 2.0 : 1.0);
}

std::string informationText(const geometry::Matrix6d& information) {
  std::string text;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      text += ' ' + base::toText(informationScale(row, column) * 0.5 * (information(row, column) + information(column, row)));
    }
  }
  return text;
}

class LineReader {
 public:
  LineReader(const std::string& line, std::string where) : words_(line), where_(std::move(where)) { words_ >> tag; }

  double number() {
    const auto [word, value] = next();
    if (!value) {
      fail("'" + word + "' found, a number expected");
    }
    if (!std::isfinite(*value)) {
      fail("'" + word + "' found, all numbers must be finite");
    }
    return *value;
  }

  int id() {
    const auto [word, value] = next();
    if (!value || *value < 0.0 || *value > std::numeric_limits<int>::max() || *value != std::floor(*value)) {
      fail("'" + word + "' found, an id expected: a whole number from 0 on");
    }
    return static_cast<int>(*value);
  }

  Eigen::Isometry3d pose() {
    std::array<double, 7> numbers{};
    for (double& n : numbers) {
      n = number();
    }
    const auto T = geometry::poseFromNumbers(numbers);
    if (!T) {
      fail("the quaternion must have norm 1 and all numbers must be finite");
    }
    return *T;
  }

  [[noreturn]] void fail(const std::string& what) const { throw base::Error(base::ErrorCode::kInput, tag + ": " + what, where_); }

  std::string tag;

 private:
  std::pair<std::string, std::optional<double>> next() {
    std::string word;
    words_ >> word;
    return {word, base::findNumber(word)};
  }

  std::istringstream words_;
  std::string where_;
};

int readNode(LineReader& reader, const std::map<int, int>& position) {
  const int id = reader.id();
  const auto found = position.find(id);
  if (found == position.end()) {
    reader.fail("vertex " + std::to_string(id) + " is not in the file above it");
  }
  return found->second;
}

Edge readEdge(LineReader& reader, const std::map<int, int>& position) {
  Edge edge;
  edge.from = readNode(reader, position);
  edge.to = readNode(reader, position);
  edge.T_from_to = reader.pose();
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      edge.information(row, column) = edge.information(column, row) = reader.number() / informationScale(row, column);
    }
  }
  return edge;
}

}  // namespace

void writeG2o(const KeyframeGraph& graph, const std::vector<char>& believed, const std::filesystem::path& file) {
  std::string text;
  std::set<int> anchored;
  for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
    text += "VERTEX_SE3:QUAT " + std::to_string(n) + poseText(graph.nodes[n].T_world_camera) + '\n';
    if (anchored.insert(graph.nodes[n].submap).second) {
      text += "FIX " + std::to_string(n) + '\n';
    }
  }
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    if (believed[e] != 0) {
      const Edge& edge = graph.edges[e];
      const Eigen::Isometry3d T_from_to = graph.nodes[static_cast<std::size_t>(edge.from)].T_world_camera.inverse() *
                                          graph.nodes[static_cast<std::size_t>(edge.to)].T_world_camera;
      text += "EDGE_SE3:QUAT " + std::to_string(edge.from) + ' ' + std::to_string(edge.to) + poseText(T_from_to) +
              informationText(edge.information) + '\n';
    }
  }
  base::writeFileAtomically(file, text);
}

KeyframeGraph readG2o(const std::filesystem::path& file) {
  std::istringstream lines(base::readFile(file));
  KeyframeGraph graph;
  std::map<int, int> position;
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::string where = file.string() + ':' + std::to_string(number);
    LineReader reader(line, where);
    if (reader.tag == "VERTEX_SE3:QUAT") {
      const int id = reader.id();
      if (!position.emplace(id, static_cast<int>(graph.nodes.size())).second) {
        reader.fail("vertex " + std::to_string(id) + " twice");
      }
      graph.nodes.emplace_back().T_world_camera = reader.pose();
    } else if (reader.tag == "EDGE_SE3:QUAT") {
      graph.edges.push_back(readEdge(reader, position));
    }
  }
  return graph;
}

}  // namespace oikos::mapping
