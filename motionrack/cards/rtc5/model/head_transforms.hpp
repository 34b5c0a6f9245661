// Transforms of the scan heads, the global transform before the correction, correction tables and gain: from corrected
// positions to outputs.
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
    /// Sets the matrix. `at_once` 0, 1, 3: from the next tick on; 2: from the next jump on. `head`: 1 A, 2 B, 3 both,
    /// 4 the global transform before the fly correction. The following functions take the same two arguments.
    Result<void> set_matrix(int head, std::array<double, 4> matrix, int at_once);
    Result<void> set_offset(int head, Point offset, int at_once);
    Result<void> set_angle(int head, double degrees, int at_once);
    Result<void> set_scale(int head, double scale, int at_once);
    /// Executes apply_mcbsp: copies offset, angle or coefficient of online positioning to a transform.
    Result<void> apply(const McBspReceiver& mcbsp, int head, int at_once);
    /// Executes the list form of one of the commands above (set_matrix_list, ..).
    void take(const Command& c);
    Result<void> set_hi(int head, Point gain, Point offset);
    /// Loads correction table 1 to 4; nullptr: 1:1.
    Result<void> load_table(std::shared_ptr<const Table> table, int number);
    /// Selects the correction tables (1 .. 4) of both heads; 0: 1:1 for head A, no output for head B.
    Result<void> select_tables(int head_a, int head_b);

    // ---- tables, which are not part of the state
    /// Returns correction table 1 .. 4; nullptr: 1:1, as for number 0.
    const Table* table(std::int64_t number) const {
        return number == 0 ? nullptr : tables_[static_cast<std::size_t>(number - 1)].get();
    }
    void clear_tables() { tables_ = {}; }
    void copy_tables(const HeadTransforms& other) { tables_ = other.tables_; }

    // ---- running
    /// Applies the transforms that wait for a jump; called when a jump begins.
    void begin_jump();
    bool wait_for_jump() const { return state_.later_count != 0; }
    /// Returns the global transform, which is applied before the correction.
    const Transform& global() const { return state_.global; }
    const Head& head(std::size_t number) const { return state_.heads[number]; }
    /// Returns true if head B has an output.
    bool second_head() const { return state_.heads[1].table != 0; }
    /// Applies the global transform to `n` positions of the block.
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
