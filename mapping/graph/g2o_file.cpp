// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/g2o_file.h"

#include <array>
#include <charconv>
#include <map>
#include <set>
#include <sstream>
#include <string>

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
std::string informationText(const geometry::Matrix6d& information) {
  std::string text;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      const double scale = (row >= 3 ? 2.0 : 1.0) * (column >= 3 ? 2.0 : 1.0);
      text += ' ' + base::toText(scale * 0.5 * (information(row, column) + information(column, row)));
    }
  }
  return text;
}

class LineReader {
 public:
  LineReader(const std::string& line, std::string where) : words_(line), where_(std::move(where)) { words_ >> tag; }

  double number() {
    std::string word;
    const auto value = words_ >> word ? base::findNumber(word) : std::nullopt;
    if (!value) {
      throw base::Error(base::ErrorCode::kInput, tag + ": '" + word + "' found, a number expected", where_);
    }
    return *value;
  }

  Eigen::Isometry3d pose() {
    std::array<double, 7> numbers{};
    for (double& n : numbers) {
      n = number();
    }
    const auto T = geometry::poseFromNumbers(numbers);
    if (!T) {
      throw base::Error(base::ErrorCode::kInput, tag + ": the quaternion must have norm 1 and all numbers must be finite", where_);
    }
    return *T;
  }

  std::string tag;

 private:
  std::istringstream words_;
  std::string where_;
};

int nodeOf(const std::map<int, int>& position, double id, const std::string& where) {
  const auto found = position.find(static_cast<int>(id));
  if (found == position.end()) {
    throw base::Error(base::ErrorCode::kInput, "edge to vertex " + base::toText(id) + ", which is not in the file above it", where);
  }
  return found->second;
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
      position[static_cast<int>(reader.number())] = static_cast<int>(graph.nodes.size());
      graph.nodes.emplace_back().T_world_camera = reader.pose();
    } else if (reader.tag == "EDGE_SE3:QUAT") {
      Edge edge;
      edge.from = nodeOf(position, reader.number(), where);
      edge.to = nodeOf(position, reader.number(), where);
      edge.T_from_to = reader.pose();
      for (int row = 0; row < 6; ++row) {
        for (int column = row; column < 6; ++column) {
          const double scale = (row >= 3 ? 2.0 : 1.0) * (column >= 3 ? 2.0 : 1.0);
          edge.information(row, column) = edge.information(column, row) = reader.number() / scale;
        }
      }
      graph.edges.push_back(edge);
    }
  }
  return graph;
}

}  // namespace oikos::mapping
