#include "scene/gltf/gltf_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace shadewright {
namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "glTF's buffers are read in place");

constexpr uint32_t glb_magic = 0x46546C67, chunk_json = 0x4E4F534A, chunk_bin = 0x004E4942;
// Sizes are checked against this first, so that products of two of them cannot overflow.
constexpr size_t largest_size = size_t{1} << 40;
// No bytes of the file stand behind the elements of an accessor that has only a sparse part.
constexpr size_t most_zeros = 100'000'000;

uint32_t word_at(const std::vector<std::byte>& bytes, size_t offset) {
  uint32_t value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

size_t component_size(int component_type) {
  switch (component_type) {
    case 5120:  // signed byte
    case 5121:  // unsigned byte
      return 1;
    case 5122:  // signed short
    case 5123:  // unsigned short
      return 2;
    case 5125:  // unsigned int
    case 5126:  // float
      return 4;
    default:
      return 0;
  }
}

template <typename Stored>
double decode(const std::byte* at, bool normalized) {
  Stored value;
  std::memcpy(&value, at, sizeof value);
  const auto number = static_cast<double>(value);
  if constexpr (std::is_integral_v<Stored>)
    if (normalized) return std::max(number / static_cast<double>(std::numeric_limits<Stored>::max()), -1.0);
  return number;
}

double decode_component(const std::byte* at, int component_type, bool normalized) {
  switch (component_type) {
    case 5120:
      return decode<int8_t>(at, normalized);
    case 5121:
      return decode<uint8_t>(at, normalized);
    case 5122:
      return decode<int16_t>(at, normalized);
    case 5123:
      return decode<uint16_t>(at, normalized);
    case 5125:
      return decode<uint32_t>(at, normalized);
    default:
      return decode<float>(at, normalized);
  }
}

size_t components_of(const std::string& type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  if (type == "VEC4") return 4;
  return 0;
}

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/// Decodes until padding or the end; nothing when there is a character that does not belong.
std::optional<std::vector<std::byte>> decode_base64(std::string_view text) {
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() / 4 * 3);
  uint32_t bits = 0;
  int bit_count = 0;
  for (const char c : text) {
    if (c == '=') break;
    const int digit = base64_digit(c);
    if (digit < 0) return std::nullopt;
    bits = (bits << 6 | static_cast<uint32_t>(digit)) & 0xFFFFFF;
    bit_count += 6;
    if (bit_count < 8) continue;
    bit_count -= 8;
    bytes.push_back(static_cast<std::byte>(bits >> bit_count & 0xFF));
  }
  return bytes;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

std::string decode_percent(const std::string& uri) {
  std::string result;
  for (size_t i = 0; i < uri.size(); ++i) {
    const bool is_escape =
        uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 && hex_digit(uri[i + 2]) >= 0;
    result += is_escape ? static_cast<char>(hex_digit(uri[i + 1]) * 16 + hex_digit(uri[i + 2])) : uri[i];
    if (is_escape) i += 2;
  }
  return result;
}

}  // namespace

const json* find_member(const json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

std::optional<size_t> find_size(const json& object, const char* key) {
  const json* member = find_member(object, key);
  if (!member) return std::nullopt;
  return get_size(object, key);
}

size_t get_size(const json& object, const char* key) {
  const json& member = object.at(key);
  // Some exporters write whole numbers as 3.0.
  if (member.is_number_float()) {
    const auto number = member.get<double>();
    if (number >= 0 && number <= static_cast<double>(largest_size) && number == std::floor(number))
      return static_cast<size_t>(number);
  } else if (member.is_number_integer() && (member.is_number_unsigned() || member.get<int64_t>() >= 0)) {
    if (const auto number = member.get<uint64_t>(); number <= largest_size) return number;
  }
  throw BadMember(std::string("\"") + key + "\" is no whole number in range");
}

std::string name_of(const json& object) {
  const json* name = find_member(object, "name");
  return name && name->is_string() ? name->get<std::string>() : std::string();
}

std::vector<std::byte> read_bytes(const std::string& path) {
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream ? std::streamoff(stream.tellg()) : -1;
  if (size < 0) throw InputError(path, "cannot be opened", "check its permissions");
  std::vector<std::byte> bytes(static_cast<size_t>(size));
  stream.seekg(0);
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), size)) throw FailureError(path, "cannot be read");
  return bytes;
}

GltfFile GltfFile::read(const std::string& path) {
  GltfFile file;
  file.path_ = path;
  const std::vector<std::byte> bytes = read_bytes(path);
  if (bytes.size() >= 4 && word_at(bytes, 0) == glb_magic) {
    file.read_glb(bytes);
  } else {
    file.read_json(bytes.data(), bytes.size());
    file.read_buffers({}, false);
  }
  return file;
}

void GltfFile::read_glb(const std::vector<std::byte>& bytes) {
  if (bytes.size() < 20) throw error("is truncated: a GLB has at least 20 bytes");
  if (word_at(bytes, 4) != 2)
    throw error("is GLB version " + std::to_string(word_at(bytes, 4)), "convert it to glTF 2.0");
  const size_t length = word_at(bytes, 8);
  if (length > bytes.size())
    throw error("is truncated: " + std::to_string(bytes.size()) + " of " + std::to_string(length) + " bytes are there",
                "copy it again");
  std::vector<std::byte> binary;
  bool has_json = false, has_binary = false;
  for (size_t offset = 12; offset + 8 <= length;) {
    const size_t size = word_at(bytes, offset), type = word_at(bytes, offset + 4);
    const std::byte* data = bytes.data() + offset + 8;
    if (size > length - offset - 8) throw error("has a chunk that reaches past its end");
    if (!has_json && type != chunk_json) throw error("does not begin with a JSON chunk");
    if (!has_json) read_json(data, size);
    if (has_json && !has_binary && type == chunk_bin) {
      binary.assign(data, data + size);
      has_binary = true;
    }
    has_json = true;
    offset += 8 + size;
  }
  if (!has_json) throw error("has no JSON chunk");
  read_buffers(std::move(binary), has_binary);
}

void GltfFile::read_json(const std::byte* first, size_t size) {
  const auto* text = reinterpret_cast<const char*>(first);
  try {
    json_ = json::parse(text, text + size);
  } catch (const json::exception&) {
    throw error("is not a glTF scene: its JSON cannot be parsed");
  }
  const json* asset = find_member(json_, "asset");
  const json* version = asset ? find_member(*asset, "version") : nullptr;
  if (!version || !version->is_string()) throw error("is not a glTF scene: it has no asset version");
  if (!version->get<std::string>().starts_with("2"))
    throw error("is glTF version " + version->get<std::string>(), "convert it to glTF 2.0");
  check_extensions();  // before buffers, which some extensions leave out
}

void GltfFile::check_extensions() const {
  const json* required = find_member(json_, "extensionsRequired");
  if (!required) return;
  for (const json& entry : *required) {
    const auto name = entry.get<std::string>();
    const bool is_fine = name == "KHR_lights_punctual" || name == "KHR_mesh_quantization" ||
                         name.find("_materials_") != std::string::npos || name.find("texture") != std::string::npos;
    if (!is_fine)
      throw error("requires the glTF extension " + name + ", which is not read", "export it without that extension");
  }
}

std::vector<std::byte> GltfFile::read_uri(const std::string& uri) const {
  if (uri.starts_with("data:")) {
    const size_t comma = uri.find(',');
    if (comma == std::string::npos || !std::string_view(uri).substr(0, comma).ends_with(";base64"))
      throw error("has a data URI that is not base64");
    auto bytes = decode_base64(std::string_view(uri).substr(comma + 1));
    if (!bytes) throw error("has a data URI with characters that are not base64");
    return std::move(*bytes);
  }
  const std::filesystem::path file = std::filesystem::path(path_).parent_path() / decode_percent(uri);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    throw error("needs the file \"" + uri + "\", which is not there", "put it beside the scene or export a .glb");
  return read_bytes(file.string());
}

void GltfFile::read_buffers(std::vector<std::byte> glb_chunk, bool has_glb_chunk) {
  for (size_t i = 0; i < count("buffers"); ++i) {
    const json& buffer = item("buffers", i);
    const json* uri = find_member(buffer, "uri");
    if (uri)
      buffers_.push_back(read_uri(uri->get<std::string>()));
    else if (i == 0 && has_glb_chunk)
      buffers_.push_back(std::move(glb_chunk));
    else
      throw error("has no data for its buffer " + std::to_string(i));
    const size_t length = get_size(buffer, "byteLength");
    if (buffers_.back().size() < length)
      throw error("is truncated: buffer " + std::to_string(i) + " has " + std::to_string(buffers_.back().size()) +
                      " of " + std::to_string(length) + " bytes",
                  "copy it again");
  }
}

const json& GltfFile::item(const char* array, size_t index) const {
  const json* items = find_member(json_, array);
  if (!items || !items->is_array() || index >= items->size())
    throw error("refers to element " + std::to_string(index) + " of \"" + array + "\", which is not there");
  return (*items)[index];
}

size_t GltfFile::count(const char* array) const {
  const json* items = find_member(json_, array);
  return items && items->is_array() ? items->size() : 0;
}

GltfFile::Range GltfFile::range_in_view(size_t view_index, size_t byte_offset, size_t count, size_t components,
                                        int component_type, const std::string& who) const {
  const json& view = item("bufferViews", view_index);
  const size_t buffer_index = get_size(view, "buffer");
  item("buffers", buffer_index);
  const std::vector<std::byte>& buffer = buffers_[buffer_index];
  const size_t view_offset = find_size(view, "byteOffset").value_or(0), view_length = get_size(view, "byteLength");
  if (view_offset > buffer.size() || view_length > buffer.size() - view_offset)
    throw error("has a buffer view (" + std::to_string(view_index) + ") that reaches past the end of its buffer");

  const size_t element = components * component_size(component_type);
  const size_t stride = find_size(view, "byteStride").value_or(element);
  if (stride < element || stride > 252 + element) throw error(who + " has an impossible stride");
  if (count > 0 && (byte_offset > view_length || element > view_length - byte_offset ||
                    (count - 1) > (view_length - byte_offset - element) / stride))
    throw error(who + " reaches past the end of its buffer view");
  return {buffer.data() + view_offset + byte_offset, count, stride, components, component_type, false};
}

GltfFile::Range GltfFile::range(size_t index, size_t components) const {
  const json& accessor = item("accessors", index);
  const std::string who = "accessor " + std::to_string(index);
  const size_t component_type = get_size(accessor, "componentType");
  const int known_type = component_type < 10000 ? static_cast<int>(component_type) : 0;
  if (component_size(known_type) == 0 || components_of(accessor.at("type").get<std::string>()) != components)
    throw error(who + " has an unexpected type");
  const std::optional<size_t> view = find_size(accessor, "bufferView");
  const size_t count = get_size(accessor, "count");
  Range result{nullptr, count, 0, components, known_type, false};
  if (view)
    result = range_in_view(*view, find_size(accessor, "byteOffset").value_or(0), count, components, known_type, who);
  else if (!find_member(accessor, "sparse"))
    throw error(who + " has no buffer view", "export the file again without compression");
  else if (count > most_zeros)
    throw error(who + " has more elements than a scene can have");
  const json* normalized = find_member(accessor, "normalized");
  result.normalized = normalized && normalized->get<bool>();
  return result;
}

size_t GltfFile::element_count(size_t accessor) const {
  return get_size(item("accessors", accessor), "count");
}

std::vector<double> GltfFile::numbers(size_t accessor, size_t components) const {
  const Range r = range(accessor, components);
  const size_t component_bytes = component_size(r.component_type);
  std::vector<double> values(r.count * components, 0.0);
  for (size_t i = 0; r.first && i < r.count; ++i)
    for (size_t c = 0; c < components; ++c)
      values[i * components + c] =
          decode_component(r.first + i * r.stride + c * component_bytes, r.component_type, r.normalized);
  apply_sparse(accessor, r, values);
  return values;
}

template <typename Value>
void GltfFile::apply_sparse(size_t accessor, const Range& base, std::vector<Value>& values) const {
  const json* sparse = find_member(item("accessors", accessor), "sparse");
  if (!sparse) return;
  const std::string who = "the sparse part of accessor " + std::to_string(accessor);
  const size_t count = get_size(*sparse, "count"), components = base.components;
  const auto part = [&](const char* key, size_t part_components, int component_type) {
    const json& object = sparse->at(key);
    return range_in_view(get_size(object, "bufferView"), find_size(object, "byteOffset").value_or(0), count,
                         part_components, component_type, who);
  };
  const size_t index_type = get_size(sparse->at("indices"), "componentType");
  if (index_type != 5121 && index_type != 5123 && index_type != 5125) throw error(who + " has an unexpected type");
  const Range at = part("indices", 1, static_cast<int>(index_type));
  const Range replacement = part("values", components, base.component_type);
  for (size_t i = 0; i < count; ++i) {
    const auto element = static_cast<size_t>(decode_component(at.first + i * at.stride, at.component_type, false));
    if (element >= base.count) throw error(who + " has an index out of range");
    for (size_t c = 0; c < components; ++c)
      values[element * components + c] = static_cast<Value>(
          decode_component(replacement.first + i * replacement.stride + c * component_size(base.component_type),
                           base.component_type, base.normalized));
  }
}

std::vector<uint32_t> GltfFile::indices(size_t accessor) const {
  Range r = range(accessor, 1);
  r.normalized = false;
  if (r.component_type != 5121 && r.component_type != 5123 && r.component_type != 5125)
    throw error("accessor " + std::to_string(accessor) + " holds indices that are not unsigned integers");
  std::vector<uint32_t> values(r.count, 0);
  for (size_t i = 0; r.first && i < r.count; ++i)
    values[i] = static_cast<uint32_t>(decode_component(r.first + i * r.stride, r.component_type, false));
  apply_sparse(accessor, r, values);
  return values;
}

}  // namespace shadewright
