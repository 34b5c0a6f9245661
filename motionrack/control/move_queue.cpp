// Entries are read in program order, and removed at the front when the machine has passed them.
#include <algorithm>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/control/move_queue.hpp>

namespace motionrack::control {

namespace {

using gcode::CanonCall;
using gcode::CanonCallKind;

/// Largest sweep of a slice of an arc: short enough that a position on it is unambiguous.
constexpr double max_sweep = 2 * pi / 3;
/// Minimum length of a slice: long enough that rounding its ends to whole pulses does not matter.
constexpr double min_pulses = 200;

}  // namespace

MoveQueue::MoveQueue(const MoveQueueSettings& settings)
    : settings_(settings), limits_(settings.limits), read_to_(settings.start) {}

// ---- reading

void MoveQueue::read_line(gcode::Interpreter& interpreter, const gcode::WorkFrame* earlier) {
    // Without an entry before it, the line is executed now.
    if (earlier != nullptr && !entries_.empty() && entries_.back().earlier_offsets == nullptr)
        entries_.back().earlier_offsets = std::make_shared<const gcode::WorkFrame>(*earlier);
    unpulled_ = line_begins_ = true;
    pull(interpreter);
}

void MoveQueue::pull(gcode::Interpreter& interpreter) {
    while (entries_.size() < settings_.max_entries) {
        if (cutting_) {
            add_piece();
            continue;
        }
        const CanonCall* step = unpulled_ ? interpreter.pull() : nullptr;
        unpulled_ = step != nullptr;
        if (step == nullptr) return;
        further_steps_ += !std::exchange(line_begins_, false);
        const bool probes = step->probe != gcode::Probe::none;
        probe_waits_ = probe_waits_ || probes;
        if (step->kind == CanonCallKind::move && step->move.kind != MoveKind::dwell && !probes)
            begin_cut(*step, false);
        else
            add_whole(*step);
    }
}

/// Adds a probing move, a dwell or an event.
void MoveQueue::add_whole(const CanonCall& step) {
    entries_.push_back({step, std::string(step.text), read_to_});
    if (step.kind != CanonCallKind::move) return;
    ++moves_;
    Move& move = entries_.back().step.move;
    move.index = read_++;
    if (on_move_) on_move_(move, read_to_);
}

void MoveQueue::add_by_hand(const Move& move) {
    CanonCall step;
    step.line = move.line;
    step.move = move;
    begin_cut(step, true);
}

void MoveQueue::begin_cut(const CanonCall& step, bool by_hand) {
    Cutting cut{step, geometry_of(step.move, read_to_)};
    cut.by_hand = by_hand;
    cut.step.move.index = read_++;
    if (on_move_) on_move_(cut.step.move, read_to_);
    if (cut.path.shape == PathShape::nothing) return;
    if (settings_.slice_s > 0) cut.pieces = pieces_of(cut.path, step.move);
    cutting_ = cut;
    ++moves_;
}

/// Returns the number of slices of a move.
int MoveQueue::pieces_of(const Geometry& path, const Move& move) const {
    const double wanted = limits_.along(path, move).velocity * settings_.slice_s;
    const Point components = max_tangent_components(path);
    double pulses = 0;  // pulses of the fastest axis per unit of length
    for (std::size_t i = 0; i < components.size(); ++i)
        pulses = std::max(pulses, components[i] * settings_.limits[i].pulses_per_unit);
    const double pieces = std::min(path.length / wanted, path.length * pulses / min_pulses);
    return static_cast<int>(
        std::max(1.0, std::ceil(std::min(std::max(pieces, std::fabs(path.sweep) / max_sweep), 1e9))));
}

void MoveQueue::add_piece() {
    const double each = cutting_->path.length / cutting_->pieces;
    const double from = each * cutting_->done++;
    const bool last = cutting_->done == cutting_->pieces;
    QueueEntry piece{cutting_->step, {}, read_to_};
    piece.last = last;
    piece.by_hand = cutting_->by_hand;
    Move& move = piece.step.move;
    move = sub_move(cutting_->step.move, cutting_->path, from, last ? cutting_->path.length : each * cutting_->done);
    if (!last && move.path == PathControl::exact_stop) move.path = PathControl::exact_path;
    read_to_ = move.end;
    entries_.push_back(std::move(piece));
    if (last) cutting_.reset();
}

// ---- planning

void MoveQueue::submit(std::int32_t moves, double seconds) {
    for (; moves > 0; ++submitted_)
        if (entries_[submitted_].is_move()) {
            entries_[submitted_].seconds = std::exchange(seconds, 0.0);
            --moves;
        }
}

double MoveQueue::submitted_seconds() const {
    double seconds = 0;
    for (std::size_t i = 0; i < submitted_; ++i) seconds += entries_[i].seconds;
    return seconds;
}

// ---- passing

void MoveQueue::pop() {
    QueueEntry& front = entries_.front();
    if (front.is_move()) {
        moves_ -= front.last;
    } else {
        line_ = front.step.line;
        front.step.text = front.text;
        if (on_event_) on_event_(front.step, passed_ - 1);
    }
    entries_.pop_front();
    planned_ -= planned_ > 0;
    submitted_ -= submitted_ > 0;
}

void MoveQueue::pop_moves(std::int64_t moves) {
    for (; moves > 0; pop()) moves -= entries_.front().is_move();
}

void MoveQueue::pop_submitted() {
    while (submitted_ > 0) pop();
}

void MoveQueue::pop_before(std::int64_t number) {
    std::size_t driven = 0;
    for (std::size_t i = 0; i < planned_; ++i)
        if (entries_[i].is_move()) {
            if (entries_[i].number >= number) break;
            driven = i + 1;
        }
    for (; driven > 0; --driven) pop();
}

// ---- standstill

std::shared_ptr<const gcode::WorkFrame> MoveQueue::clear(const Point& position) {
    std::shared_ptr<const gcode::WorkFrame> earlier;
    for (const QueueEntry& entry : entries_)
        if (earlier = entry.earlier_offsets; earlier != nullptr) break;
    entries_.clear();
    cutting_.reset();
    moves_ = 0;
    unpulled_ = probe_waits_ = false;
    planned_ = submitted_ = 0;
    read_to_ = position;
    return earlier;
}

void MoveQueue::end_probe(const Point& position) {
    probe_waits_ = false;
    --moves_;
    entries_.pop_front();
    planned_ = submitted_ = 0;
    read_to_ = position;
}

}  // namespace motionrack::control
