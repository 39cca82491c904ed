// paged: resolution-matched shadow maps (Lefohn, Sengupta, Owens, "Resolution-Matched Shadow Maps", 2007), after
// adaptive shadow maps (Fernando et al. 2001): a quadtree of pages of 32 x 32 texels over a virtual map of the whole
// scene.
//
// 1. Each pixel marks the pages it will read: one bit a page, at the level whose texels have the pixel's own size.
// 2. The marks are counted and scanned: a page's slot in the pool is the number of marked pages before it. A block of
//    8 x 4 pages of which many are marked gets all of its slots, side by side, and is drawn as one.
// 3. Clusters that touch a marked page are found, and of their triangles the (triangle, page or block) pairs. Of closed
//    bodies a sun needs the facing sides only.
// 4. The pairs are drawn straight into the pool: by one draw those that stay inside, by another the small ones that do
//    not (their fragments outside are thrown away), by a third those that are clipped at the border.
// 5. A look-up finds its page by one read of the table; where none is, by the next coarser one.
// The paper sorts requests (here: bits, no sort; requests=sort is the paper's way), draws 1,024^2 superpages and copies
// pages out of them (here: no copy; draw=superpages is the paper's way).
#pragma once

#include <functional>

#include "gpu/scan.h"
#include "shadow/parameterization/paged/caster_changes.h"
#include "shadow/parameterization/paged/request_list.h"
#include "shadow/parameterization/paged/shared.h"
#include "shadow/parameterization/paged/superpages.h"
#include "shadow/parameterization/parameterization.h"
#include "shadow/parameterization/uniform/fit.h"

namespace shadewright::shadow {

class Paged final : public Parameterization {
 public:
  /// InputError where the resolution is no power of two, or the table would not fit.
  Paged(const gpu::Device& device, const Spec& spec, const TechniqueOptions& options);

  Traits traits() const override {
    return {.contiguous = false,
            .gpu_driven = true,
            .needs_readback = waits(),
            .without_readback = "choose refine=none, requests=bits, analysis=gpu and draw=pages"};
  }
  MapExtent map_extent(LightKind light) const override;
  std::unique_ptr<CasterDraws> make_caster_draws(LightKind light, uint32_t frames_in_flight) override;
  void prepare(const Frame& frame, gpu::Recorder& recorder) override;
  void refine(const Frame& frame, const ReceiverLookup& lookup, gpu::Recorder& recorder,
              const std::function<void()>& draw) override;
  void record(const Frame& frame, const ReceiverLookup& lookup, gpu::Recorder& recorder) override;
  std::span<const MapView> views() const override { return views_; }

  std::vector<gpu::BindingKind> lookup_kinds() const override;
  std::vector<gpu::Binding> lookup_bindings(uint32_t slot) const override;

  Counters counters() const override;
  std::vector<Allocation> allocations() const override;
  std::vector<std::string> debug_names() const override { return {"pages", "page-use"}; }
  /// pages: each pixel in the colour of its level, page borders dark (figure 4). page-use: each page of the table by
  /// how many of its texels are read (figure 14).
  Picture debug_picture(std::string_view name, const ReceiverLookup& lookup) override;

  const gpu::Buffer& state() const { return state_; }
  /// Bits of the pages to draw, and of those that are or hold one.
  const gpu::Buffer& pages_to_draw() const { return draw_; }
  const gpu::Buffer& pages_to_draw_or_finer() const { return draw_or_finer_; }
  /// What is emptied before it is drawn: units (see page_clear.vert); their draw is in the state.
  const gpu::Buffer& emptied() const { return emptied_; }
  uint32_t pool_texels() const { return pool_texels_; }
  /// Texels an axis of a level.
  double level_texels(uint32_t level) const { return spec_.resolution >> level; }
  /// Of draw=superpages: those that hold a page to draw, and the numbers of their pages.
  std::span<const Superpage> superpages() const { return superpages_; }
  const gpu::Buffer& superpage_pages() const { return superpage_pages_[slot_]; }
  /// Keeps the frame's state where `counters` reads it.
  void record_results(const vk::raii::CommandBuffer& commands) const;

 private:
  void make_tables(LightKind light);
  /// Finds the virtual map's views, with a share of its size to spare on each side.
  void fit(const Frame& frame, double margin);
  /// True if all that receives still falls inside the map.
  bool fits(const Frame& frame) const;
  void write_constants(const Frame& frame);
  void make_passes(const ReceiverLookup& lookup);
  /// True if the host must know what the device has found before it can go on.
  bool waits() const { return edges_ || listed_ || bins_superpages_; }
  /// Marks the pages that the frame's pixels ask for: the `iteration`th time, of refine=edges.
  void find_requests(const Frame& frame, const ReceiverLookup& lookup, gpu::Recorder& recorder, uint32_t iteration);
  /// Has pixels ask by way of the list.
  void find_list(const Frame& frame, const ReceiverLookup& lookup, gpu::Recorder& recorder);
  void empty_requests(const vk::raii::CommandBuffer& commands);
  /// Asks for all pages of the level that refinement starts from, and that serves what a coarser analysis misses.
  void record_seed(const vk::raii::CommandBuffer& commands) const;
  /// Dispatches a pass over the camera's pixels that requests pages.
  void dispatch_pixels(const gpu::ComputePass& pass, const Frame& frame, const ReceiverLookup& lookup,
                       const vk::raii::CommandBuffer& commands) const;
  /// Marks which texels of the pool the look-up reads: a bit each, in `used`.
  void record_statistics(const gpu::Buffer& used, const ReceiverLookup& lookup,
                         const vk::raii::CommandBuffer& commands) const;
  gpu::Buffer used_texels_buffer() const;
  Picture page_use(const ReceiverLookup& lookup) const;
  void record_allocation(const ReceiverLookup& lookup, const vk::raii::CommandBuffer& commands);
  /// Bins the pages to draw on the host, which waits for them.
  void find_superpages(gpu::Recorder& recorder);

  const gpu::Device& device_;
  Spec spec_;
  uint32_t frames_in_flight_, pool_texels_, top_ = 0, finest_ = 0, analysis_scale_ = 1, words_ = 0, faces_ = 0;
  bool cached_, edges_;
  bool listed_, on_host_;  ///< requests come by a list; the host makes it unique
  Uniquify uniquify_;
  uint32_t iterations_ = 0, raw_requests_ = 0, unique_requests_ = 0, pages_drawn_ = 0;  ///< of refine=edges, a frame
  bool bins_superpages_;
  uint32_t superpage_count_ = 0;  ///< drawn in the last frame
  std::vector<Superpage> superpages_;
  gpu::Buffer draw_on_host_;                  ///< `draw_`, host-read
  std::vector<gpu::Buffer> superpage_pages_;  ///< by slot: host-written
  RequestCounts list_counts_;                 ///< in the last frame
  CasterChanges changes_;
  bool table_is_void_ = true, new_fit_ = true;
  std::vector<MapView> views_;
  std::vector<LightFrame> light_frames_;  ///< of the views
  std::vector<Box> held_;                 ///< what each view holds, see receiver_bounds
  gpu::ComputePass requests_pass_, edges_pass_, levels_pass_, plan_pass_, counts_pass_, allocate_pass_,
      statistics_pass_, invalidate_pass_;
  RequestList list_;
  gpu::Scan scan_;
  std::vector<gpu::Buffer> constants_, results_;  ///< by slot: host-written, host-read
  uint32_t slot_ = 0;
  gpu::Buffer state_, requested_, requested_or_finer_, placed_, valid_, draw_, draw_or_finer_, counts_, table_,
      emptied_;
  gpu::Buffer used_;  ///< of statistics=on
};

}  // namespace shadewright::shadow
