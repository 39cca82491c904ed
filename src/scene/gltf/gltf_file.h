// A glTF 2.0 file as JSON and buffers, every range checked before it is touched: what comes out of here is in bounds,
// whatever the file's bytes are. (Khronos, glTF 2.0 specification, sections 3.6 and 4.)
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "shadewright/error.h"

namespace shadewright {

class GltfFile {
 public:
  /// Reads GLB or glTF JSON, told apart by content, with the buffers it refers to. Throws InputError.
  static GltfFile read(const std::string& path);

  /// The file's JSON, an object with an "asset".
  const nlohmann::json& root() const { return json_; }

  /// The element `index` of a top-level array ("nodes", "meshes", ...). Throws InputError when there is none.
  const nlohmann::json& item(const char* array, size_t index) const;
  /// Length of a top-level array, 0 without it.
  size_t count(const char* array) const;

  /// All components of an accessor in order, as numbers; normalized integers become [0, 1] or [-1, 1].
  /// `components` is how many an element must have. Throws InputError.
  std::vector<double> numbers(size_t accessor, size_t components) const;
  /// The elements of an accessor of unsigned integers (indices).
  std::vector<uint32_t> indices(size_t accessor) const;
  /// Number of elements of an accessor.
  size_t element_count(size_t accessor) const;

  /// An InputError that names this file.
  InputError error(const std::string& problem, const std::string& mend = "export the file again") const {
    return {path_, problem, mend};
  }

 private:
  /// Where an accessor's elements are; the whole range is inside the buffer. Without `first` they are zeros.
  struct Range {
    const std::byte* first = nullptr;
    size_t count = 0, stride = 0, components = 0;
    int component_type = 0;
    bool normalized = false;
  };

  void read_glb(const std::vector<std::byte>& bytes);
  void read_json(const std::byte* first, size_t size);
  void read_buffers(std::vector<std::byte> glb_chunk, bool has_glb_chunk);
  std::vector<std::byte> read_uri(const std::string& uri) const;
  Range range_in_view(size_t view, size_t byte_offset, size_t count, size_t components, int component_type,
                      const std::string& who) const;
  Range range(size_t accessor, size_t components) const;
  /// Replaces the elements that the accessor's sparse part names.
  template <typename Value>
  void apply_sparse(size_t accessor, const Range& base, std::vector<Value>& values) const;
  /// Extensions that a file requires are refused unless they only touch looks, or are read.
  void check_extensions() const;

  std::string path_;
  nlohmann::json json_;
  std::vector<std::vector<std::byte>> buffers_;
};

/// A member of the JSON has another value than glTF allows. Like nlohmann's own exceptions it becomes an InputError in
/// one place, read_gltf.
class BadMember : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A member that is an index or a size: a non-negative whole number. Nothing when it is absent; throws BadMember for
/// anything else.
std::optional<size_t> find_size(const nlohmann::json& object, const char* key);
/// The same for a member that must be there.
size_t get_size(const nlohmann::json& object, const char* key);
/// The member, or nothing when `object` is no object or has none of this name.
const nlohmann::json* find_member(const nlohmann::json& object, const char* key);
/// The name of a node, mesh, ...; empty when it has none.
std::string name_of(const nlohmann::json& object);

/// The bytes of a whole file. InputError when it cannot be opened, FailureError when reading fails.
std::vector<std::byte> read_bytes(const std::string& path);

}  // namespace shadewright
