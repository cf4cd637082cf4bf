// What an evaluation keeps, and what it makes of it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "evaluate/evaluate.h"
#include "evaluate/plot.h"
#include "evaluate/report_tables.h"
#include "evaluate/statistics.h"
#include "evaluate/store.h"
#include "io/file.h"

namespace wrapatlas {
namespace {

namespace fs = std::filesystem;

Run run_of(const std::string& contender, int width, int height, double efficiency,
           double seconds = 1, bool searched = false) {
  Run run;
  run.contender = contender;
  run.searched_shape = searched;
  run.packing.width = width;
  run.packing.height = height;
  run.packing.efficiency = efficiency;
  run.packing.raster_seconds = seconds / 4;
  run.seconds = seconds;
  return run;
}

MeshResult mesh_of(const std::string& id, std::vector<Run> runs, const std::string& group = "g") {
  MeshResult mesh;
  mesh.facts.id = id;
  mesh.facts.group = group;
  mesh.facts.file = "folder/" + id + ".obj";
  mesh.facts.charts = 3;
  mesh.runs = std::move(runs);
  return mesh;
}

/// Two meshes by two of the paper's packers and guided.
std::vector<MeshResult> two_meshes() {
  return {
      mesh_of("a", {run_of("swg03", 8, 8, 0.4), run_of("swg03", 16, 4, 0.6),
                    run_of("modulo", 8, 8, 0.5), run_of("modulo", 16, 4, 0.55),
                    run_of("guided 1 s", 8, 8, 0.7), run_of("guided 1 s", 16, 4, 0.8, 2, true)}),
      mesh_of("b", {run_of("swg03", 8, 8, 0.3), run_of("swg03", 16, 4, 0.2),
                    run_of("modulo", 8, 8, 0.3), run_of("modulo", 16, 4, 0.1),
                    run_of("guided 1 s", 8, 8, 0.2), run_of("guided 1 s", 8, 8, 0.25, 2, true)})};
}

const std::vector<std::string> kThree{"swg03", "modulo", "guided 1 s"};

TEST(Statistics, SquareAndBestShape) {
  const std::vector<MeshResult> meshes = two_meshes();
  const Reached square = reached(meshes[0], "swg03", Shapes::square);
  EXPECT_EQ(square.efficiency, 0.4);
  EXPECT_EQ(square.seconds, 1);
  const Reached any = reached(meshes[0], "swg03", Shapes::variable);
  EXPECT_EQ(any.efficiency, 0.6);
  EXPECT_EQ(any.seconds, 2) << "of all shapes that were tried";
  EXPECT_EQ(any.run, &meshes[0].runs[1]);
  const Reached search = reached(meshes[0], "guided 1 s", Shapes::variable);
  EXPECT_EQ(search.efficiency, 0.8);
  EXPECT_EQ(search.seconds, 2) << "a search for the shape stands for itself";
  EXPECT_EQ(reached(meshes[1], "guided 1 s", Shapes::square).efficiency, 0.2)
      << "that a search ended on a square does not make it one";
  EXPECT_EQ(reached(meshes[0], "nobody", Shapes::variable).run, nullptr);
}

TEST(Statistics, Summary) {
  std::vector<MeshResult> meshes = two_meshes();
  meshes.push_back(mesh_of("c", {}));
  meshes.back().error = "broken";
  const auto table = summarize(meshes, kThree, Shapes::square);
  ASSERT_EQ(table.size(), 3U);
  EXPECT_EQ(table[0].best_of_paper, 0.5) << "equals are both best";
  EXPECT_EQ(table[1].best_of_paper, 1);
  EXPECT_EQ(table[0].best_of_all, 0.5);
  EXPECT_EQ(table[2].best_of_all, 0.5);
  EXPECT_DOUBLE_EQ(table[1].mean, 0.4);
  EXPECT_DOUBLE_EQ(table[1].median, 0.4);
  EXPECT_EQ(table[1].min, 0.3);
  EXPECT_EQ(table[1].max, 0.5);
  EXPECT_EQ(table[1].raster_seconds, 0.25);
  EXPECT_TRUE(summarize({}, kThree, Shapes::square).empty());
}

TEST(Statistics, ARunThatFailedCountsAsNothing) {
  std::vector<MeshResult> meshes = two_meshes();
  meshes[0].runs[2].error = "check: overlap";
  const auto table = summarize(meshes, kThree, Shapes::square);
  EXPECT_EQ(table[1].min, 0);
  EXPECT_DOUBLE_EQ(table[1].mean, 0.15);
}

TEST(Statistics, MeansByShape) {
  const auto means = means_by_shape(two_meshes(), "modulo");
  ASSERT_EQ(means.size(), 2U);
  EXPECT_EQ(means[0].aspect, 1);
  EXPECT_DOUBLE_EQ(means[0].mean, 0.4);
  EXPECT_EQ(means[1].aspect, 4);
  EXPECT_EQ(means_by_shape(two_meshes(), "guided 1 s").size(), 1U) << "the square alone is a shape";
}

TEST(Statistics, ClaimsNeedThePapersFour) {
  EXPECT_TRUE(claims(two_meshes(), kThree, true).empty());
  std::vector<MeshResult> meshes{
      mesh_of("a", {run_of("lprm02", 8, 8, 0.3), run_of("swg03", 8, 8, 0.4),
                    run_of("zsgs04", 8, 8, 0.4), run_of("modulo", 8, 8, 0.5)})};
  const std::vector<std::string> four{"lprm02", "swg03", "zsgs04", "modulo"};
  for (const Claim& claim : claims(meshes, four, false)) EXPECT_TRUE(claim.holds) << claim.text;
  meshes[0].runs[0].packing.efficiency = 0.6;
  for (const Claim& claim : claims(meshes, four, false)) EXPECT_FALSE(claim.holds) << claim.text;
}

TEST(ReportTables, MarkdownAndHtml) {
  const Table table = group_table(two_meshes(), kThree);
  EXPECT_EQ(as_markdown(table),
            "| kind | meshes | charts, median | swg03 | modulo | guided 1 s |\n"
            "|---|---:|---:|---:|---:|---:|\n"
            "| g | 2 | 3 | 0.350 | 0.400 | 0.450 |\n");
  Table odd;
  odd.head = {"a<b"};
  odd.rows = {{"x & \"y\""}};
  EXPECT_NE(as_html(odd).find("a&lt;b"), std::string::npos);
  EXPECT_NE(as_html(odd).find("x &amp; &quot;y&quot;"), std::string::npos);
}

TEST(MeshResult, ComesBackFromJson) {
  MeshResult mesh = two_meshes()[0];
  mesh.facts.l2 = 1.5;
  mesh.runs[0].packing.wrap = Wrap::u;
  mesh.runs[0].packing.placements = {{0.5, {1.25, -3}, 0}};
  mesh.runs[1].error = "no scale";
  const auto back = result_from(result_json(mesh).dump());
  ASSERT_TRUE(back);
  EXPECT_EQ(result_json(*back), result_json(mesh));
  EXPECT_EQ(back->runs[0].packing.placements[0].translation, (Vec2{1.25, -3}));
  EXPECT_EQ(back->runs[0].packing.wrap, Wrap::u);
  for (const char* text : {"", "{}", "{\"mesh\": 3}", "[1"}) {
    EXPECT_EQ(result_from(text).error().kind, ErrorKind::input) << text;
  }
}

Setting setting_of(std::vector<std::string> names) {
  Setting setting;
  for (const std::string& name : names)
    setting.contenders.push_back({name, Method::modulo, Wrap::uv});
  return setting;
}

TEST(MeshResult, CsvHasAsManyFieldsInEachRow) {
  MeshResult odd = mesh_of("a", {run_of("modulo", 8, 8, 0.5)}, "with, \"quotes\"");
  const std::string rows = csv_rows(odd, setting_of({"modulo"}));
  EXPECT_NE(rows.find("\"with, \"\"quotes\"\"\""), std::string::npos);
  const auto commas = [](std::string text) {
    bool quoted = false;
    int count = 0;
    for (const char c : text) {
      if (c == '"') quoted = !quoted;
      if (c == ',' && !quoted) ++count;
    }
    return count;
  };
  EXPECT_EQ(commas(rows), commas(csv_header()));
  odd.error = "cannot, read";
  EXPECT_EQ(commas(csv_rows(odd, setting_of({"modulo"}))), commas(csv_header()));
}

class StoreTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) / ("wrapatlas_store_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(StoreTest, KeepsMeshesOfOneSetting) {
  Setting setting = setting_of({"modulo"});
  {
    const auto store = Store::open(folder_, setting);
    ASSERT_TRUE(store);
    EXPECT_FALSE(store->has("b10"));
    for (const char* id : {"b10", "b9"}) {
      ASSERT_TRUE(store->put(mesh_of(id, {run_of("modulo", 8, 8, 0.5)})));
    }
    EXPECT_TRUE(store->has("b10"));
    ASSERT_TRUE(store->write_csv(setting));
  }
  ASSERT_TRUE(Store::open(folder_, setting));
  EXPECT_EQ(read_results(folder_)->size(), 2U);
  const auto csv = read_file(folder_ / "runs.csv");
  ASSERT_TRUE(csv);
  EXPECT_EQ(csv->substr(0, csv_header().size()), csv_header());
  setting.pack.padding = 5;
  const auto other = Store::open(folder_, setting);
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().kind, ErrorKind::usage);
  EXPECT_NE(other.error().what.find("--padding: 2.0 there, 5.0 here"), std::string::npos);
}

TEST_F(StoreTest, LeavesOtherFoldersAlone) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "mine.txt") << "mine";
  EXPECT_EQ(Store::open(folder_, setting_of({"modulo"})).error().kind, ErrorKind::usage);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
  EXPECT_EQ(read_results(folder_).error().kind, ErrorKind::input);
}

TEST_F(StoreTest, SaysWhichFileIsBroken) {
  const auto store = Store::open(folder_, setting_of({"modulo"}));
  ASSERT_TRUE(store);
  std::ofstream(folder_ / "meshes" / "x.json") << "{\"mesh\"";
  EXPECT_NE(read_results(folder_).error().where.find("x.json"), std::string::npos);
}

TEST_F(StoreTest, FindsMeshesAndTheirKinds) {
  fs::create_directories(folder_ / "psb");
  for (const char* name : {"psb/20.off", "psb/21.off", "psb/400.off", "psb/notes.txt"}) {
    std::ofstream(folder_ / name) << "OFF\n";
  }
  const std::vector<std::string> paths{(folder_ / "psb").string()};
  const auto meshes = find_meshes(paths);
  ASSERT_TRUE(meshes);
  ASSERT_EQ(meshes->size(), 3U);
  EXPECT_EQ((*meshes)[0].group, "psb human");
  EXPECT_EQ((*meshes)[1].group, "psb cup");
  EXPECT_EQ((*meshes)[2].group, "psb four-legged");
  EXPECT_EQ((*meshes)[2].id, "psb-400");
}

TEST(Plot, EscapesAndStaysWithinItsFrame) {
  Plot plot;
  plot.title = "a < b & c";
  plot.x = {"x", true, 0.125, 8};
  plot.y = {"y"};
  plot.series = {{"<one>", {{0.125, 0}, {1, 0.5}, {8, 1}, {1e9, 7}}}, {"none", {}}};
  const std::string svg = draw_plot(plot);
  EXPECT_NE(svg.find("a &lt; b &amp; c"), std::string::npos);
  EXPECT_NE(svg.find("&lt;one&gt;"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  EXPECT_NE(svg.find(">0.2<"), std::string::npos) << "ticks at round numbers";
  EXPECT_NE(svg.find(">5<"), std::string::npos);
}

}  // namespace
}  // namespace wrapatlas
