#include "wrapatlas/charts.h"
#include "wrapatlas/model.h"
#include "wrapatlas/pack.h"

wrapatlas::Status pack_file(const char* from, const char* to) {
  const auto model = wrapatlas::load_model(from);
  if (!model) return model.error();
  const auto charts = wrapatlas::build_charts(model->mesh);
  if (!charts) return charts.error();

  wrapatlas::PackOptions options;
  options.width = options.height = 2048;
  options.padding = 4;
  const auto packing = wrapatlas::pack(charts->charts, options);
  if (!packing) return packing.error();

  const auto atlas = wrapatlas::export_continuous(model->mesh, *charts, *packing);
  return wrapatlas::save_model(*model, atlas, to);
}

// Until here it is the example of the README. A program around it: pack_file IN OUT.
#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const wrapatlas::Status done = pack_file(argv[1], argv[2]);
  if (!done) std::fprintf(stderr, "%s\n", done.error().message().c_str());
  return done ? 0 : 1;
}
