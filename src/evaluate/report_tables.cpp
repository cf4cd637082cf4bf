#include "evaluate/report_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "evaluate/plot.h"

namespace wrapatlas {
namespace {

/// Table 1 of the paper; efficiencies in percent (its smallest and largest at a variable aspect
/// ratio stand there as fractions).
struct PaperColumn {
  const char* contender;
  double best, mean, min, max, raster, total;
};
constexpr std::array kVariable{PaperColumn{"lprm02", 0, 45, 17, 90, 1.91, 5.45},
                               PaperColumn{"swg03", 0.8, 54, 21, 91, 29.03, 38.11},
                               PaperColumn{"zsgs04", 0.5, 53, 19, 91, 26.99, 34.25},
                               PaperColumn{"modulo", 98.7, 63, 26, 92, 36.16, 55.35}};
constexpr std::array kSquare{PaperColumn{"lprm02", 0.3, 40, 6, 78, 0.19, 0.29},
                             PaperColumn{"swg03", 4.5, 48, 13, 77, 3.27, 3.58},
                             PaperColumn{"zsgs04", 1.3, 48, 13, 78, 3.06, 3.44},
                             PaperColumn{"modulo", 93.9, 57, 13, 84, 4.08, 4.70}};

/// A value of ours, and the paper's in brackets.
std::string beside(const std::string& ours, const PaperColumn* paper, double PaperColumn::*value,
                   const char* format) {
  if (!paper) return ours;
  return fmt::format("{} ({})", ours, fmt::format(fmt::runtime(format), paper->*value));
}

std::string percent(double share) { return fmt::format("{:.1f}", 100 * share); }
std::string seconds(double value) { return fmt::format("{:.3g}", value); }

void add_block(Table& table, const char* title, std::span<const Summary> summaries,
               std::span<const PaperColumn> paper) {
  table.headings.push_back(table.rows.size());
  table.rows.push_back({title});
  const auto add = [&](const char* name, auto&& cell) {
    std::vector<std::string> row{name};
    for (const Summary& summary : summaries) {
      const auto column = std::find_if(paper.begin(), paper.end(), [&](const PaperColumn& c) {
        return summary.contender == c.contender;
      });
      row.push_back(cell(summary, column == paper.end() ? nullptr : &*column));
    }
    table.rows.push_back(std::move(row));
  };
  const auto efficiency = [](double Summary::*ours, double PaperColumn::*theirs) {
    return [=](const Summary& s, const PaperColumn* p) {
      return beside(percent(s.*ours), p, theirs, "{:g}");
    };
  };
  const auto time = [](double Summary::*ours, double PaperColumn::*theirs) {
    return [=](const Summary& s, const PaperColumn* p) {
      return beside(seconds(s.*ours), p, theirs, "{:g}");
    };
  };
  const auto of_paper = [](const Summary& s) { return is_of_paper(s.contender); };
  if (std::count_if(summaries.begin(), summaries.end(), of_paper) == std::ssize(kSquare)) {
    add("best of the paper's four, % of meshes", [&](const Summary& s, const PaperColumn* p) {
      if (!of_paper(s)) return std::string();
      return beside(percent(s.best_of_paper), p, &PaperColumn::best, "{:g}");
    });
  }
  if (!std::all_of(summaries.begin(), summaries.end(), of_paper) || paper.empty()) {
    add("best of all here, %",
        [](const Summary& s, const PaperColumn*) { return percent(s.best_of_all); });
  }
  add("mean efficiency, %", efficiency(&Summary::mean, &PaperColumn::mean));
  add("median efficiency, %",
      [](const Summary& s, const PaperColumn*) { return percent(s.median); });
  add("smallest, %", efficiency(&Summary::min, &PaperColumn::min));
  add("largest, %", efficiency(&Summary::max, &PaperColumn::max));
  add("rasterising, mean s", [&](const Summary& s, const PaperColumn* p) {
    if (!p && s.raster_seconds == 0) return std::string();
    return beside(seconds(s.raster_seconds), p, &PaperColumn::raster, "{:g}");
  });
  add("all of packing, mean s", time(&Summary::seconds, &PaperColumn::total));
}

std::vector<std::string> head_of(const char* first, std::span<const std::string> contenders) {
  std::vector<std::string> head{first};
  head.insert(head.end(), contenders.begin(), contenders.end());
  return head;
}

}  // namespace

Table paper_table(std::span<const MeshResult> meshes, std::span<const std::string> contenders,
                  bool all_shapes, bool beside_paper) {
  using Columns = std::span<const PaperColumn>;
  Table table;
  table.head = head_of("", contenders);
  if (all_shapes) {
    add_block(table, "Variable aspect ratio", summarize(meshes, contenders, Shapes::variable),
              beside_paper ? Columns(kVariable) : Columns());
  }
  add_block(table, "Square", summarize(meshes, contenders, Shapes::square),
            beside_paper ? Columns(kSquare) : Columns());
  return table;
}

Table group_table(std::span<const MeshResult> meshes, std::span<const std::string> contenders) {
  Table table;
  table.head = head_of("kind", contenders);
  table.head.insert(table.head.begin() + 1, {"meshes", "charts, median"});
  for (std::size_t begin = 0; begin < meshes.size();) {
    std::size_t end = begin;
    std::vector<MeshResult> group;
    std::vector<std::size_t> charts;
    for (; end < meshes.size() && meshes[end].facts.group == meshes[begin].facts.group; ++end) {
      if (!meshes[end].error.empty()) continue;
      group.push_back(meshes[end]);
      charts.push_back(meshes[end].facts.charts);
    }
    const std::string name = meshes[begin].facts.group;
    begin = end;
    if (group.empty()) continue;
    std::sort(charts.begin(), charts.end());
    std::vector<std::string> row{name, fmt::format("{}", group.size()),
                                 fmt::format("{}", charts[charts.size() / 2])};
    for (const Summary& summary : summarize(group, contenders, Shapes::square)) {
      row.push_back(fmt::format("{:.3f}", summary.mean));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table mesh_table(std::span<const MeshResult> meshes, std::span<const std::string> contenders,
                 bool all_shapes) {
  Table table;
  table.head = head_of("mesh", contenders);
  table.head.insert(table.head.begin() + 1, {"kind", "charts", "L2 stretch"});
  for (const MeshResult& mesh : meshes) {
    if (!mesh.error.empty()) continue;
    const MeshFacts& facts = mesh.facts;
    std::vector<std::string> row{facts.id, facts.group, fmt::format("{}", facts.charts),
                                 facts.unwrapped ? fmt::format("{:.2f}", facts.l2) : ""};
    for (const std::string& contender : contenders) {
      std::string cell = fmt::format("{:.3f}", reached(mesh, contender, Shapes::square).efficiency);
      if (all_shapes) {
        cell += fmt::format(" / {:.3f}", reached(mesh, contender, Shapes::variable).efficiency);
      }
      row.push_back(std::move(cell));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string as_html(const Table& table) {
  std::string html = "<div class=\"wide\"><table>\n<tr>";
  for (const std::string& cell : table.head) html += "<th>" + escaped(cell) + "</th>";
  html += "</tr>\n";
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const bool is_heading =
        std::find(table.headings.begin(), table.headings.end(), i) != table.headings.end();
    if (is_heading) {
      html += fmt::format("<tr><th class=\"block\" colspan=\"{}\">{}</th></tr>\n",
                          table.head.size(), escaped(table.rows[i].front()));
      continue;
    }
    html += "<tr>";
    for (const std::string& cell : table.rows[i]) html += "<td>" + escaped(cell) + "</td>";
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

std::string as_markdown(const Table& table) {
  std::string text = "|";
  for (const std::string& cell : table.head) text += " " + cell + " |";
  text += "\n|---|";
  for (std::size_t i = 1; i < table.head.size(); ++i) text += "---:|";
  text += "\n";
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    std::vector<std::string> row = table.rows[i];
    if (std::find(table.headings.begin(), table.headings.end(), i) != table.headings.end()) {
      row.front() = "**" + row.front() + "**";
    }
    row.resize(table.head.size());
    text += "|";
    for (const std::string& cell : row) text += " " + cell + " |";
    text += "\n";
  }
  return text;
}

}  // namespace wrapatlas
