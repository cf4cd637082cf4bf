#include "pack/request.h"
#include "wrapatlas/validate.h"

namespace wrapatlas {

CheckOptions promises_of(const PackOptions& options, const Packing& packing, bool cut) {
  CheckOptions promises;
  promises.width = packing.width;
  promises.height = packing.height;
  promises.wrap = cut ? Wrap::none : packing.wrap;
  promises.cut = cut ? packing.wrap : Wrap::none;
  promises.padding = options.padding;
  promises.margin = margin_in_force(options);
  promises.pages = packing.pages;
  promises.threads = options.threads;
  return promises;
}

}  // namespace wrapatlas
