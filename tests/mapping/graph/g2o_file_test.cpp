// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/g2o_file.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "core/base/read_file.h"
#include "tests/mapping/graph/simulated_drive.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace oikos::mapping {
namespace {

constexpr const char* kTwoVertices =
    "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\n"
    "FIX 0\n"
    "VERTEX_SE3:QUAT 1 1 0 0 0 0 0 1\n";
constexpr const char* kInformation = " 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 4 0 0 4 0 4";

std::vector<std::string> wordsOf(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) {
    words.push_back(word);
  }
  return words;
}

std::vector<std::string> linesWith(const std::string& text, const std::string& tag) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with(tag + ' ')) {
      lines.push_back(line);
    }
  }
  return lines;
}

KeyframeGraph readText(const std::string& text) {
  const test::TemporaryFolder folder;
  return readG2o(folder.write("graph.g2o", text));
}

TEST(G2oFile, PosesAndEdgesComeBack) {
  SimulatedDrive drive(1);
  drive.addLoop(3, 43);
  const test::TemporaryFolder folder;
  writeG2o(drive.graph, drive.allBelieved(), folder.path() / "graph.g2o");
  const KeyframeGraph read = readG2o(folder.path() / "graph.g2o");
  ASSERT_EQ(read.nodes.size(), drive.graph.nodes.size());
  ASSERT_EQ(read.edges.size(), drive.graph.edges.size());
  for (std::size_t n = 0; n < read.nodes.size(); ++n) {
    EXPECT_LT((read.nodes[n].T_world_camera.matrix() - drive.graph.nodes[n].T_world_camera.matrix()).norm(), 1e-12);
  }
  for (std::size_t e = 0; e < read.edges.size(); ++e) {
    EXPECT_EQ(read.edges[e].from, drive.graph.edges[e].from);
    EXPECT_EQ(read.edges[e].to, drive.graph.edges[e].to);
    EXPECT_LT((read.edges[e].information - drive.graph.edges[e].information).norm(), 1e-6 * drive.graph.edges[e].information.norm());
  }
}

/// Whoever optimises the file finds it at its optimum: the edges say what the poses say.
TEST(G2oFile, EdgesAgreeWithThePoses) {
  SimulatedDrive drive(2);
  drive.addLoop(3, 43);
  const test::TemporaryFolder folder;
  writeG2o(drive.graph, drive.allBelieved(), folder.path() / "graph.g2o");
  const KeyframeGraph read = readG2o(folder.path() / "graph.g2o");
  for (const Edge& e : read.edges) {
    const Eigen::Isometry3d T_from_to =
        read.nodes[static_cast<std::size_t>(e.from)].T_world_camera.inverse() * read.nodes[static_cast<std::size_t>(e.to)].T_world_camera;
    EXPECT_LT((T_from_to.matrix() - e.T_from_to.matrix()).norm(), 1e-10);
  }
}

TEST(G2oFile, DoubtedLoopsAreLeftOut) {
  SimulatedDrive drive(3);
  const std::size_t doubted = drive.addLoop(3, 43);
  std::vector<char> believed = drive.allBelieved();
  believed[doubted] = 0;
  const test::TemporaryFolder folder;
  writeG2o(drive.graph, believed, folder.path() / "graph.g2o");
  EXPECT_EQ(readG2o(folder.path() / "graph.g2o").edges.size(), drive.graph.edges.size() - 1);
}

TEST(G2oFile, TheFirstNodeOfEachSubmapIsFixed) {
  SimulatedDrive drive(4);
  drive.breakAt(30, Eigen::Isometry3d::Identity());
  drive.breakAt(60, Eigen::Isometry3d::Identity());
  const test::TemporaryFolder folder;
  writeG2o(drive.graph, drive.allBelieved(), folder.path() / "graph.g2o");
  const auto fixed = linesWith(base::readFile(folder.path() / "graph.g2o"), "FIX");
  EXPECT_EQ(fixed, (std::vector<std::string>{"FIX 0", "FIX 30", "FIX 60"}));
}

/// g2o's rotation is the quaternion's vector part, half the angle: four times the information of the angle, twice where it
/// meets the translation.
TEST(G2oFile, InformationIsOfTheQuaternionsVectorPart) {
  KeyframeGraph graph;
  graph.nodes.resize(2);
  Edge edge;
  edge.from = 0;
  edge.to = 1;
  edge.information.setConstant(0.25);
  edge.information.diagonal() << 10.0, 20.0, 30.0, 40.0, 50.0, 60.0;
  graph.edges.push_back(edge);
  const test::TemporaryFolder folder;
  writeG2o(graph, {1}, folder.path() / "graph.g2o");
  const auto lines = linesWith(base::readFile(folder.path() / "graph.g2o"), "EDGE_SE3:QUAT");
  ASSERT_EQ(lines.size(), 1U);
  const std::vector<std::string> words = wordsOf(lines[0]);
  const std::vector<std::string> upper(words.begin() + 10, words.end());
  const std::vector<std::string> expected = {"10", "0.25", "0.25", "0.5", "0.5", "0.5", "20", "0.25", "0.5", "0.5", "0.5",
                                             "30", "0.5",  "0.5",  "0.5", "160", "1",   "1",  "200",  "1",   "240"};
  EXPECT_EQ(upper, expected);
  EXPECT_LT((readG2o(folder.path() / "graph.g2o").edges[0].information - edge.information).norm(), 1e-12);
}

TEST(G2oFile, IdsNeedNotBeginAtZeroAndOtherLinesAreLeftOut) {
  const KeyframeGraph graph = readText(
      "# a comment\n"
      "PARAMS_SE3OFFSET 0 0 0 0 0 0 0 1\n"
      "VERTEX_SE3:QUAT 100 1 2 3 0 0 0 1\n"
      "VERTEX_SE3:QUAT 7 4 5 6 0 0 1 0\n"
      "EDGE_SE3:QUAT 100 7 3 3 3 0 0 1 0" +
      std::string(kInformation) + "\n");
  ASSERT_EQ(graph.nodes.size(), 2U);
  ASSERT_EQ(graph.edges.size(), 1U);
  EXPECT_EQ(graph.edges[0].from, 0);
  EXPECT_EQ(graph.edges[0].to, 1);
  EXPECT_TRUE(graph.nodes[1].T_world_camera.translation().isApprox(Eigen::Vector3d(4.0, 5.0, 6.0)));
  EXPECT_TRUE(graph.edges[0].information.isApprox(geometry::Matrix6d::Identity()));
}

struct Rejection {
  const char* name;
  std::string text;
  std::vector<std::string> parts;
};

class G2oRejection : public testing::TestWithParam<Rejection> {};

TEST_P(G2oRejection, NamesFileAndLine) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.write("graph.g2o", GetParam().text);
  std::vector<std::string> parts = GetParam().parts;
  parts[0] = file.string() + ':' + parts[0];
  test::expectError(base::ErrorCode::kInput, parts, [&] { static_cast<void>(readG2o(file)); });
}

INSTANTIATE_TEST_SUITE_P(
    G2oFile, G2oRejection,
    testing::Values(
        Rejection{"NoNumber", "VERTEX_SE3:QUAT 0 0 zero 0 0 0 0 1\n", {"1", "'zero'", "a number"}},
        Rejection{"ShortVertex", std::string(kTwoVertices) + "VERTEX_SE3:QUAT 2 0 0 0\n", {"4", "a number"}},
        Rejection{"NoUnitQuaternion", "\nVERTEX_SE3:QUAT 0 0 0 0 0 0 0 2\n", {"2", "quaternion"}},
        Rejection{"NotFinite", "VERTEX_SE3:QUAT 0 nan 0 0 0 0 0 1\n", {"1", "finite"}},
        Rejection{"UnknownVertex", std::string(kTwoVertices) + "EDGE_SE3:QUAT 0 5 1 0 0 0 0 0 1" + kInformation + "\n", {"4", "vertex 5"}},
        Rejection{"ShortInformation", std::string(kTwoVertices) + "EDGE_SE3:QUAT 0 1 1 0 0 0 0 0 1 1 0 0\n", {"4", "a number"}},
        Rejection{"InfiniteInformation",
                  std::string(kTwoVertices) + "EDGE_SE3:QUAT 0 1 1 0 0 0 0 0 1 inf 0 0 0 0 0 1 0 0 0 0 1 0 0 0 4 0 0 4 0 4\n",
                  {"4", "finite"}},
        Rejection{"BrokenId", "VERTEX_SE3:QUAT 0.5 0 0 0 0 0 0 1\n", {"1", "'0.5'", "an id"}},
        Rejection{"HugeId", "VERTEX_SE3:QUAT 1e300 0 0 0 0 0 0 1\n", {"1", "'1e300'", "an id"}},
        Rejection{"SameIdTwice", std::string(kTwoVertices) + "VERTEX_SE3:QUAT 1 0 0 0 0 0 0 1\n", {"4", "vertex 1", "twice"}}),
    [](const auto& parameter) { return std::string(parameter.param.name); });

TEST(G2oFile, AMissingFileIsAnIoError) {
  const test::TemporaryFolder folder;
  test::expectError(base::ErrorCode::kIo, {"none.g2o"}, [&] { static_cast<void>(readG2o(folder.path() / "none.g2o")); });
}

TEST(G2oFile, AFolderThatIsNotThereIsAnIoError) {
  const test::TemporaryFolder folder;
  test::expectError(base::ErrorCode::kIo, {"no-such"}, [&] { writeG2o(KeyframeGraph{}, {}, folder.path() / "no-such" / "graph.g2o"); });
}

}  // namespace
}  // namespace oikos::mapping
