// What a texel keeps of the closest occluder: owns the map that casters are drawn into. Its GLSL module answers for a
// point (architecture, section 1).
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "shadewright/gpu/pass.h"
#include "shadewright/shadow/technique.h"
#include "shadow/caster_draws.h"
#include "shadow/shared.h"

namespace shadewright::shadow {

/// What a storage is built for.
struct StorageDesc {
  const Spec& spec;
  MapExtent extent;
  CasterDraws& draws;                     ///< outlive the storage
  vk::DescriptorSetLayout lookup_layout;  ///< set 1 of the casters' pipelines
};

class Storage {
 public:
  virtual ~Storage() = default;
  /// Records the drawing of the casters, which have been culled; the map is left in shader-read layout.
  virtual void record(const Frame& frame, vk::DescriptorSet lookup_set, gpu::Recorder& recorder) = 0;
  /// What the GLSL module reads, bound from `storage_binding` on; of the kinds that its traits tell.
  virtual std::vector<gpu::Binding> lookup_bindings() const = 0;
  /// What its GLSL module reads of LookupData besides.
  virtual void write_lookup(shared::LookupData&) const {}
  /// What the GLSL module may know already when it is compiled: specialization constant 2 of a look-up. 0: nothing.
  virtual uint32_t lookup_constant() const { return 0; }
  virtual std::vector<Allocation> allocations() const = 0;
  virtual Counters counters() const { return {}; }
  /// The debug picture of a name that is one of its traits' `debug_names`, of the last recorded frame. Waits.
  virtual Picture debug_picture(std::string_view name) = 0;
};

/// What is known of a storage before there is one.
struct StorageTraits {
  std::vector<gpu::BindingKind> lookup_kinds;  ///< of what its GLSL module reads
  std::vector<std::string> debug_names;
  std::vector<std::string> decisions = {};  ///< how its look-up may come to an answer; empty where it does not tell
  bool in_passes = false;  ///< its look-up tells more and more at a growing price (STORAGE_PASSES in its GLSL module)
  bool takes_callbacks = true;  ///< casters may be drawn by the caller's own pipeline
};
StorageTraits storage_traits(std::string_view storage);

/// The storage that `desc.spec` names.
std::unique_ptr<Storage> make_storage(const gpu::Device& device, const StorageDesc& desc);

}  // namespace shadewright::shadow
