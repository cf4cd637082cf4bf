// wrapatlas pack: read a model, pack its charts, check the result, write it.

#include "packing_run.h"

namespace wrapatlas::cli {
namespace {

int run(const CLI::App& app, PackArguments& arguments) {
  const double start = seconds_now();
  if (const Status ok = resolve_pack_options(app, arguments); !ok) return report_error(ok.error());
  if (const Status ok = check_outputs(arguments); !ok) return report_error(ok.error());
  PackOutcome outcome;
  LoadOptions load_options;
  load_options.texcoord_set = arguments.texcoord;
  load_options.in_scene = leaves_nodes_behind(arguments.input, arguments.output);
  const auto model = load_model(arguments.input, load_options);
  if (!model) return report_error(model.error());
  if (const Status ok = keep_input(arguments, *model); !ok) return report_error(ok.error());
  outcome.read = seconds_now() - start;
  return pack_mesh(arguments, *model, model->mesh, start, outcome);
}

}  // namespace

Command make_pack_command(CLI::App& parser) {
  auto arguments = std::make_shared<PackArguments>();
  CLI::App& app = *parser.add_subcommand("pack", "Pack the charts of a model that has UVs");
  add_pack_options(app, *arguments, "Model with UVs: .obj .ply .off .gltf .glb");
  add_choice(app, "--stacked", arguments->stacked, kStacked,
             "Charts that lie on each other in the input: separate them, or keep them together "
             "(they go on sharing texels)");
  app.footer(std::string(kPackExitStatus) +
             "Examples:\n"
             "  wrapatlas pack model.glb -o packed.glb --resolution 2048 --image atlas.png\n"
             "  wrapatlas pack model.obj -o packed.obj --wrap none --padding 4\n"
             "  wrapatlas pack model.obj -o packed.obj --aspect search --json -\n"
             "  wrapatlas pack level.obj -o packed.obj --density 256 --udim");
  return {&app, [arguments, &app] { return run(app, *arguments); }};
}

}  // namespace wrapatlas::cli
