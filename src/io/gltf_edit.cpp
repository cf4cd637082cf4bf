#include "io/gltf_edit.h"

#include <algorithm>

#include "io/gltf_references.h"

namespace wrapatlas {
namespace {

constexpr std::string_view kZeros("\0\0\0\0\0\0\0\0", 8);

void mark(std::vector<bool>& live, const Json& index) {
  const auto number = as_integer(index);
  if (number && *number < live.size()) live[*number] = true;
}

bool has_extensions(const Json& value) { return find_member(value, "extensions") != nullptr; }

/// The ids of what was live and no longer is, below `count`.
std::vector<std::uint64_t> died(const std::vector<bool>& before, const std::vector<bool>& after,
                                std::uint64_t count) {
  std::vector<std::uint64_t> dead;
  for (std::uint64_t i = 0; i < count; ++i) {
    if (before[i] && !after[i]) dead.push_back(i);
  }
  return dead;
}

std::vector<bool> live_accessors(const Json& json) {
  std::vector<bool> live(array_member(json, "accessors").size());
  for_each_accessor_use(json, [&](const Json& index) { mark(live, index); });
  for_each_extension_integer(json, [&](std::uint64_t i) {
    if (i < live.size()) live[i] = true;
  });
  return live;
}

std::vector<bool> live_views(const Json& json) {
  std::vector<bool> live(array_member(json, "bufferViews").size());
  for (const Json& accessor : array_member(json, "accessors")) {
    for_each_view_use(accessor, [&](const Json& index) { mark(live, index); });
  }
  for (const Json& image : array_member(json, "images")) {
    if (const Json* index = find_member(image, "bufferView")) mark(live, *index);
  }
  for_each_extension_integer(json, [&](std::uint64_t i) {
    if (i < live.size()) live[i] = true;
  });
  return live;
}

}  // namespace

void GltfPieces::pad(std::uint64_t alignment, std::uint64_t remainder) {
  add(kZeros.substr(0, (alignment + remainder - size % alignment) % alignment));
}

GltfEdit::GltfEdit(const GltfFile& file)
    : json(file.json),
      file_(file),
      old_accessors_(array_member(json, "accessors").size()),
      old_views_(array_member(json, "bufferViews").size()) {
  // Objects keep their members in vectors. With room for all that may be added to the outermost
  // one, references into it stay good while accessors are added to a file that has none.
  constexpr std::size_t kMostAdded = 16;
  auto& members = json.get_ref<Json::object_t&>();
  members.reserve(members.size() + kMostAdded);
}

std::uint64_t GltfEdit::add_accessor(Json accessor, std::string bytes, std::size_t stride,
                                     GltfTarget target) {
  return add_array(std::move(accessor), {std::move(bytes), {}}, stride, target);
}

std::uint64_t GltfEdit::add_accessor(Json accessor, std::string_view bytes, GltfTarget target) {
  return add_array(std::move(accessor), {{}, bytes}, 0, target);
}

std::uint64_t GltfEdit::add_array(Json accessor, NewView bytes, std::size_t stride,
                                  GltfTarget target) {
  Json& views = json["bufferViews"];
  Json& accessors = json["accessors"];
  Json view = {{"buffer", 0}, {"byteOffset", 0}, {"byteLength", bytes.bytes().size()}};
  if (stride != 0) view["byteStride"] = stride;
  view["target"] = static_cast<int>(target);
  bytes.view = views.size();
  new_views_.push_back(std::move(bytes));
  accessor["bufferView"] = views.size();
  views.push_back(std::move(view));
  accessors.push_back(std::move(accessor));
  return accessors.size() - 1;
}

std::uint64_t GltfEdit::add_image(const std::string& name, std::string bytes,
                                  const char* mime_type) {
  Json& views = json["bufferViews"];
  Json& images = json["images"];
  images.push_back({{"name", name}, {"mimeType", mime_type}, {"bufferView", views.size()}});
  views.push_back({{"buffer", 0}, {"byteOffset", 0}, {"byteLength", bytes.size()}});
  new_views_.push_back({std::move(bytes), {}, views.size() - 1});
  return images.size() - 1;
}

void GltfEdit::drop_stale_extensions() {
  // The views of an optional compression hold all the data themselves.
  for (const char* extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    bool removed = false;
    for (const char* directory : {"bufferViews", "buffers"}) {
      if (!json.contains(directory)) continue;
      for (Json& value : json[directory]) removed = remove_extension(value, extension) || removed;
    }
    if (removed) unlist_extension(json, extension);
  }
}

/// New elements, from `first_new` on, take the places of dead ones; what is dead at the end of the
/// directory goes. Leaves in final_number_ where each element went; returns the dead ones left.
std::vector<std::uint64_t> GltfEdit::move_into(const char* directory, std::uint64_t first_new,
                                               std::vector<std::uint64_t> dead) {
  final_number_.clear();
  if (!json.contains(directory)) return {};
  Json& elements = json[directory];
  for (std::uint64_t i = 0; i < elements.size(); ++i) final_number_.push_back(i);
  std::size_t used = 0;
  Json::array_t kept(elements.begin(), elements.begin() + static_cast<std::ptrdiff_t>(first_new));
  for (std::uint64_t i = first_new; i < elements.size(); ++i) {
    if (used < dead.size()) {
      final_number_[i] = dead[used];
      kept[dead[used++]] = std::move(elements[i]);
    } else {
      final_number_[i] = kept.size();
      kept.push_back(std::move(elements[i]));
    }
  }
  dead.erase(dead.begin(), dead.begin() + static_cast<std::ptrdiff_t>(used));
  while (!dead.empty() && dead.back() + 1 == kept.size()) {
    kept.pop_back();
    dead.pop_back();
  }
  elements = std::move(kept);
  if (elements.empty()) json.erase(directory);
  return dead;
}

void GltfEdit::finish() {
  drop_stale_extensions();
  const auto renumber = [&](std::uint64_t first_new) {
    return [this, first_new](Json& index) {
      const auto number = as_integer(index);
      if (number && *number >= first_new && *number < final_number_.size()) {
        index = final_number_[*number];
      }
    };
  };
  move_into("accessors", old_accessors_,
            died(live_accessors(file_.json), live_accessors(json), old_accessors_));
  for_each_accessor_use(json, renumber(old_accessors_));

  const std::vector<std::uint64_t> dead =
      died(live_views(file_.json), live_views(json), old_views_);
  const std::vector<std::uint64_t> left = move_into("bufferViews", old_views_, dead);
  if (json.contains("accessors")) {
    for (Json& accessor : json["accessors"]) for_each_view_use(accessor, renumber(old_views_));
  }
  if (json.contains("images")) {
    for (Json& image : json["images"]) {
      if (image.contains("bufferView")) renumber(old_views_)(image["bufferView"]);
    }
  }
  for (NewView& view : new_views_) view.view = final_number_[view.view];

  std::vector<bool> view_died(old_views_);
  for (const std::uint64_t view : dead) view_died[view] = true;
  for (const std::uint64_t view : left) {  // its number must stay taken: shrink it
    Json& json_view = json["bufferViews"][view];
    json_view["byteLength"] =
        std::min<std::uint64_t>(4, *integer_member(json_view, "byteLength", 4));
    json_view.erase("byteStride");
    view_died[view] = false;
  }
  lay_out(view_died);
}

void GltfEdit::lay_out(const std::vector<bool>& view_died) {
  for (std::uint64_t b = 0; b < file_.buffers.size(); ++b) {
    buffers_.emplace_back();
    storage_.push_back(file_.buffers[b].storage);
    copy_live_ranges(b, view_died);
  }
  std::uint64_t target = 0;
  while (target < storage_.size() && storage_[target] == GltfBuffer::Storage::absent) ++target;
  if (target == storage_.size() && !new_views_.empty()) {
    buffers_.emplace_back();
    storage_.push_back(file_.binary && target == 0 ? GltfBuffer::Storage::bin_chunk
                                                   : GltfBuffer::Storage::data_uri);
    json["buffers"].push_back(Json::object());
  }
  for (const NewView& added : new_views_) {
    buffers_[target].pad(4);
    Json& view = json["bufferViews"][added.view];
    view["buffer"] = target;
    view["byteOffset"] = buffers_[target].size;
    buffers_[target].add(added.bytes());
  }
  drop_empty_buffers();
  for (std::uint64_t b = 0; b < buffers_.size(); ++b) {
    if (storage_[b] != GltfBuffer::Storage::absent)
      json["buffers"][b]["byteLength"] = buffers_[b].size;
  }
}

/// A buffer must not be empty. Those at the end go; others stay, so that no buffer is renumbered.
void GltfEdit::drop_empty_buffers() {
  const auto is_empty = [&](std::size_t b) {
    return storage_[b] != GltfBuffer::Storage::absent && buffers_[b].size == 0;
  };
  std::vector<bool> named(buffers_.size());  // by an extension, as far as we can tell
  for_each_extension_integer(json, [&](std::uint64_t i) {
    if (i < named.size()) named[i] = true;
  });
  while (!buffers_.empty() && is_empty(buffers_.size() - 1) && !named[buffers_.size() - 1]) {
    buffers_.pop_back();
    storage_.pop_back();
    json["buffers"].erase(buffers_.size());
  }
  if (buffers_.empty()) json.erase("buffers");
  for (std::size_t b = 0; b < buffers_.size(); ++b) {
    if (is_empty(b)) buffers_[b].add(kZeros.substr(0, 4));
  }
}

/// Copies what live views of the buffer cover, in order; all of it if none of its views died or an
/// extension may know more about the buffer than we do.
void GltfEdit::copy_live_ranges(std::uint64_t buffer, const std::vector<bool>& view_died) {
  struct Range {
    std::uint64_t begin = 0, end = 0, moved_to = 0;
  };
  const std::string_view bytes = file_.buffers[buffer].bytes;
  const Json& old_views = array_member(file_.json, "bufferViews");
  std::vector<Range> ranges;
  std::vector<std::uint64_t> live;
  bool whole = true, fixed = has_extensions(json["buffers"][buffer]);
  for (std::uint64_t i = 0; i < old_views.size(); ++i) {
    if (*integer_member(old_views[i], "buffer", 0) != buffer) continue;
    if (view_died[i]) {
      whole = false;
      continue;
    }
    fixed = fixed || has_extensions(json["bufferViews"][i]);
    const std::uint64_t begin = *integer_member(old_views[i], "byteOffset", 0);
    const std::uint64_t length = *integer_member(json["bufferViews"][i], "byteLength", 0);
    whole = whole && length == *integer_member(old_views[i], "byteLength", 0);
    ranges.push_back({begin, begin + length});
    live.push_back(i);
  }
  if (whole || fixed) {
    buffers_[buffer].add(bytes);
    return;
  }
  std::sort(ranges.begin(), ranges.end(),
            [](const Range& a, const Range& b) { return a.begin < b.begin; });
  std::vector<Range> merged;
  for (const Range& range : ranges) {
    if (!merged.empty() && range.begin < merged.back().end) {
      merged.back().end = std::max(merged.back().end, range.end);
    } else {
      merged.push_back(range);
    }
  }
  for (Range& range : merged) {
    buffers_[buffer].pad(8, range.begin % 8);  // keeps every alignment anything may need
    range.moved_to = buffers_[buffer].size;
    buffers_[buffer].add(bytes.substr(range.begin, range.end - range.begin));
  }
  for (const std::uint64_t i : live) {
    Json& view = json["bufferViews"][i];
    const std::uint64_t begin = *integer_member(view, "byteOffset", 0);
    const auto after =
        std::upper_bound(merged.begin(), merged.end(), begin,
                         [](std::uint64_t at, const Range& r) { return at < r.begin; });
    const Range& range = *std::prev(after);
    const std::uint64_t moved = range.moved_to + (begin - range.begin);
    if (moved != 0 || view.contains("byteOffset")) view["byteOffset"] = moved;
  }
}

}  // namespace wrapatlas
