// The transforms of the scan heads and before the correction, the correction tables, gain: from corrected positions to
// outputs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <motionrack/cards/rtc5/model/block_buffers.hpp>
#include <motionrack/cards/rtc5/model/mcbsp_receiver.hpp>
#include <motionrack/cards/rtc5/model/state.hpp>
#include <string_view>

namespace motionrack::rtc5 {

class HeadTransforms {
  public:
    /// `state` is part of the card's state and must outlive this.
    HeadTransforms(TransformsState& state, BlockBuffers& buffers) : state_(state), buffers_(buffers) {}

    // ---- commands
    /// at_once 0, 1, 3: with the next tick; 2: with the next jump. `head`: 1 A, 2 B, 3 both, 4 all, before fly.
    Result<void> set_matrix(int head, std::array<double, 4> matrix, int at_once);
    Result<void> set_offset(int head, Point offset, int at_once);
    Result<void> set_angle(int head, double degrees, int at_once);
    Result<void> set_scale(int head, double scale, int at_once);
    /// apply_mcbsp
    Result<void> apply(const McBspReceiver& mcbsp, int head, int at_once);
    /// set_matrix_list and the like
    void take(const Command& c);
    Result<void> set_hi(int head, Point gain, Point offset);
    /// Loads table 1 to 4; nullptr: 1:1.
    Result<void> load_table(std::shared_ptr<const Table> table, int number);
    /// Selects the tables of head A and B, 0 .. 4; 0: A: 1:1, B: no output.
    Result<void> select_tables(int head_a, int head_b);

    // ---- tables, which are not part of the state
    /// Table 1 .. 4; nullptr: 1:1.
    const Table* table(std::int64_t number) const {
        return number == 0 ? nullptr : tables_[static_cast<std::size_t>(number - 1)].get();
    }
    void clear_tables() { tables_ = {}; }
    void copy_tables(const HeadTransforms& other) { tables_ = other.tables_; }

    // ---- running
    /// A jump begins: transforms that wait for it apply.
    void begin_jump();
    bool wait_for_jump() const { return state_.later_count != 0; }
    /// The transform before the correction.
    const Transform& global() const { return state_.global; }
    const Head& head(std::size_t number) const { return state_.heads[number]; }
    /// Head B has an output.
    bool second_head() const { return state_.heads[1].table != 0; }
    /// Transforms n positions of the block before the correction.
    void transform_block(std::size_t n) {
        if (!state_.global.neutral) kernels::transform(buffers_.x.data(), buffers_.y.data(), n, state_.global);
    }
    /// Computes n outputs of a head from the corrected positions of the block.
    void run_head(std::size_t number, std::size_t n);

  private:
    template <class Change>
    Result<void> change_transforms(std::string_view command, int head, int at_once, const Change& change);

    TransformsState& state_;
    BlockBuffers& buffers_;
    std::array<std::shared_ptr<const Table>, table_count> tables_;
};

}  // namespace motionrack::rtc5
