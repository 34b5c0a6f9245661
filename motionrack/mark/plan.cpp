// Converts a job to the commands of a list: millimetres to bits, speeds to bits/ms, and the belt movement to a scale.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/mark/plan.hpp>
#include <motionrack/mark/wait_batches.hpp>

namespace motionrack::mark {

namespace {

using rtc5::Command;
using rtc5::Op;

/// Collects commands; stores the first error.
class List {
  public:
    explicit List(double bits_per_mm) : k_(bits_per_mm) {}

    void put(Op op, std::initializer_list<double> parameters = {}) {
        if (error_) return;
        const auto made = rtc5::list_command(op, parameters);
        if (made)
            commands_.push_back(*made);
        else
            error_ = made.error();
    }
    /// Converts mm/s to bits/ms; rejects values that the card would clip.
    void speed(Op op, const char* name, double mm_s) {
        const double bits_ms = mm_s * k_ / 1000;
        const rtc5::KindInfo range = rtc5::kind_info(rtc5::Kind::speed);
        if (bits_ms < range.min || bits_ms > range.max)
            refuse(
                fmt::format("{} of {:g} mm/s is {:g} bits/ms; the card takes {:g} to {:g}, which is {:g} to {:g} mm/s",
                            name, mm_s, bits_ms, range.min, range.max, range.min * 1000 / k_, range.max * 1000 / k_));
        put(op, {bits_ms});
    }
    double bits(double mm) {
        const double out = std::floor(mm * k_ + 0.5);
        const rtc5::KindInfo range = rtc5::kind_info(rtc5::Kind::coordinate);
        if (!(out >= range.min && out <= range.max))
            refuse(fmt::format("a position at {:g} mm is beyond the card's virtual field of {:g} mm each way", mm,
                               range.max / k_));
        return out;
    }
    void refuse(std::string sentence) {
        if (!error_) error_ = Error{ErrorKind::refused, std::move(sentence) + ". Nothing was marked."};
    }
    Result<std::vector<Command>> take() {
        if (error_) return tl::unexpected(*error_);
        return std::move(commands_);
    }

  private:
    double k_;
    std::vector<Command> commands_;
    std::optional<Error> error_;
};

struct Direction {
    double x = 0, y = 0;
};
/// Returns the direction of the belt as a unit vector; along X or Y, the other component is exactly 0.
Direction direction_of(const parts::ConveyorSettings& track) {
    const SinCos d = sin_cos(track.direction_deg * (pi / 180));
    const auto clean = [](double v) { return std::fabs(v) < 1e-12 ? 0.0 : v; };
    return {clean(d.cos), clean(d.sin)};
}

/// Appends the commands that correct for a linear movement along X, Y or both.
void put_linear(List& list, const MarkingJob& job, const Prepared& prepared, const ConveyorTracking& following) {
    const Direction d = direction_of(following.track);
    const double scale = prepared.bits_per_mm * job.fly.scale_factor / counts_per_unit(job, following);
    if (following.mode == FlyMode::mcbsp) {
        if (d.x != 0) list.put(Op::set_fly_x_pos, {scale * (d.y != 0 ? 1 : d.x)});
        if (d.y != 0) list.put(Op::set_fly_y_pos, {scale * (d.x != 0 ? 1 : d.y)});
    } else if (d.x != 0 && d.y != 0 && !job.parts) {
        // Activates both at once, so that neither counter starts a tick later; both are 0 at the start of the list.
        list.put(Op::activate_fly_xy, {scale * d.x, scale * d.y});
    } else {
        // With [parts], the external start resets the encoders.
        if (d.x != 0) list.put(Op::set_fly_x, {scale * d.x});
        if (d.y != 0) list.put(Op::set_fly_y, {scale * d.y});
    }
}

void put_fly(List& list, const MarkingJob& job, const Prepared& prepared, const ConveyorTracking& following) {
    const double unit = counts_per_unit(job, following);
    if (following.mode == FlyMode::off || unit == 0) return;
    const bool words = following.mode == FlyMode::mcbsp;
    if (!following.corrects) {
        // A scale of 0 corrects nothing, but set_fly_x zeroes the encoder, so that the waits count from 0.
        if (job.fly.wait_mode != WaitMode::none && !words) list.put(Op::set_fly_x, {0});
        return;
    }
    if (!following.track.rotary) return put_linear(list, job, prepared, following);
    const Spot centre = following.track.centre_mm;
    list.put(Op::set_rot_center_list, {list.bits(centre.x), list.bits(centre.y)});
    const double resolution = 360 * unit / job.fly.scale_factor;
    if (std::fabs(resolution) < rtc5::min_resolution)
        list.refuse(fmt::format("{:g} counts a turn; under {:g} the card's rotary correction is off", resolution,
                                rtc5::min_resolution));
    list.put(words ? Op::set_fly_rot_pos : Op::set_fly_rot, {resolution});
}

/// Shifts all marks by the belt travel in offset_us. It uses the global transform, which precedes the correction, so
/// the field flags include the shift.
void put_offset(List& list, const MarkingJob& job, const ConveyorTracking& following) {
    constexpr double before_fly = 4;
    if (job.fly.offset_us == 0 || !following.corrects) return;
    const double travel = following.track.profile[0].velocity * job.fly.offset_us * 1e-6;
    Spot offset;
    if (following.track.rotary) {
        const SinCos t = sin_cos(travel * (pi / 180));
        const Spot c = following.track.centre_mm;
        list.put(Op::set_angle_list, {before_fly, travel, 0});
        offset = {c.x - (t.cos * c.x - t.sin * c.y), c.y - (t.sin * c.x + t.cos * c.y)};
    } else {
        const Direction d = direction_of(following.track);
        offset = {travel * d.x, travel * d.y};
    }
    list.put(Op::set_offset_list, {before_fly, list.bits(offset.x), list.bits(offset.y), 0});
}

void put_settings(List& list, const MarkingJob& job) {
    list.speed(Op::set_jump_speed, "A jump speed", job.pace.jump_speed_mm_s);
    list.speed(Op::set_mark_speed, "A mark speed", job.pace.mark_speed_mm_s);
    list.put(Op::set_scanner_delays,
             {job.pace.jump_delay_us / 10, job.pace.mark_delay_us / 10, job.pace.polygon_delay_us / 10});
    list.put(Op::set_laser_delays, {job.pace.laser_on_us * 2, job.pace.laser_off_us * 2});
}

/// Appends the marks and arcs of a stroke, shifted. `jump`: a jump to its start comes first; else the position is
/// already there.
void put_stroke(List& list, const Stroke& stroke, Spot shift, bool jump) {
    if (jump) list.put(Op::jump_abs, {list.bits(stroke.from.x + shift.x), list.bits(stroke.from.y + shift.y)});
    for (const Element& e : stroke.elements) {
        if (e.sweep == 0)
            list.put(Op::mark_abs, {list.bits(e.to.x + shift.x), list.bits(e.to.y + shift.y)});
        else
            list.put(Op::arc_abs,
                     {list.bits(e.centre.x + shift.x), list.bits(e.centre.y + shift.y), -e.sweep * (180 / pi)});
    }
}

/// Appends a wait until the belt has moved by `travel` (mm).
void put_wait(List& list, const MarkingJob& job, const ConveyorTracking& following, double travel) {
    const double unit = counts_of(job, following, travel), rising = unit < 0 ? -1 : 1;
    if (following.mode == FlyMode::mcbsp)
        list.put(Op::wait_for_mcbsp, {direction_of(following.track).x != 0 ? 0.0 : 1.0, unit, rising});
    else
        list.put(Op::wait_for_encoder_mode, {unit, 0, rising});
}

/// Appends the batches. Each waits with the spot parked at its start in the field, so that the waiting spot does not
/// leave the field with the part.
Result<void> put_batches(List& list, const MarkingJob& job, const Prepared& prepared, const ConveyorTracking& following,
                         const Drawing& drawing) {
    const double margin = job.fly.margin_mm, sense = job.sense();
    Box field = prepared.field();
    field = {{field.low.x + margin, field.low.y + margin}, {field.high.x - margin, field.high.y - margin}};
    if (!(field.low.x < field.high.x))
        return fail(ErrorKind::refused,
                    fmt::format("A margin of {:g} mm exceeds a field of {:.3f} mm. Nothing was marked.", margin,
                                field.high.x - field.low.x + 2 * margin));
    const Direction d = direction_of(following.track);
    const Spot movement{d.x * sense, d.y * sense};
    MOTIONRACK_TRY(const std::vector<WaitBatch> batches, batches_of(drawing, field, movement));
    for (const WaitBatch& batch : batches) {
        const Spot travel{movement.x * batch.at_mm, movement.y * batch.at_mm}, begin = batch.strokes[0].from;
        const Spot shift = following.corrects ? Spot{} : travel;
        const bool waits = batch.at_mm > 0;
        if (waits) {
            const double x = list.bits(begin.x + travel.x), y = list.bits(begin.y + travel.y);
            following.corrects ? list.put(Op::park_position, {0, x, y}) : list.put(Op::jump_abs, {x, y});
            put_wait(list, job, following, batch.at_mm);
            if (following.corrects) list.put(Op::park_return, {1, list.bits(begin.x), list.bits(begin.y)});
        }
        for (std::size_t i = 0; i < batch.strokes.size(); ++i)
            put_stroke(list, batch.strokes[i], shift, i > 0 || !waits);
    }
    return {};
}

/// Refuses a drawing that lies outside the field and that no movement brings into it: the card would only mark a line
/// on the field edge.
Result<void> check_reaches_field(const Drawing& drawing, const Box& field, const ConveyorTracking& following) {
    const auto& profile = following.track.profile;
    const bool carried =
        following.mode != FlyMode::off &&
        std::any_of(profile.begin(), profile.end(), [](const parts::VelocityPoint& p) { return p.velocity != 0; });
    const Box box = box_of(drawing);
    if (carried || (box.low.x <= field.high.x && box.high.x >= field.low.x && box.low.y <= field.high.y &&
                    box.high.y >= field.low.y))
        return {};
    return fail(
        ErrorKind::refused,
        fmt::format("The drawing goes from X {:.3f} to {:.3f} mm and from Y {:.3f} to {:.3f} mm, outside the field, "
                    "which goes from {:.3f} to {:.3f} mm each way; no movement brings it into the field. "
                    "Nothing was marked; move the drawing or make it smaller.",
                    box.low.x, box.high.x, box.low.y, box.high.y, field.low.x, field.high.x));
}

}  // namespace

Box Prepared::field() const {
    return {{rtc5::min_field / bits_per_mm, rtc5::min_field / bits_per_mm},
            {rtc5::max_field / bits_per_mm, rtc5::max_field / bits_per_mm}};
}

ConveyorTracking following_of(const MarkingJob& job, double factor) {
    ConveyorTracking out{job.track(), job.fly.mode, job.fly.simulated_velocity.value_or(job.belt.velocity) * factor,
                         true};
    for (parts::VelocityPoint& point : out.track.profile) point.velocity *= factor;
    return out;
}

double counts_per_unit(const MarkingJob& job, const ConveyorTracking& following) {
    switch (following.mode) {
        case FlyMode::mcbsp:
            return job.sender.bits_per_mm;
        case FlyMode::simulated:
            return following.simulated_velocity != 0 ? 1e6 / following.simulated_velocity : 0;
        default:
            return following.track.counts_per_unit;
    }
}

double counts_of(const MarkingJob& job, const ConveyorTracking& following, double travel) {
    const double unit = counts_per_unit(job, following);
    return std::floor(travel * (following.mode == FlyMode::simulated ? std::fabs(unit) : unit * job.sense()) + 0.5);
}

Result<Prepared> prepare(const MarkingJob& job, const Load& load) {
    Prepared out;
    const PartsSettings parts = job.parts.value_or(PartsSettings{});
    const std::size_t different = has_numbers(job) ? parts.size() : 1;
    std::size_t elements = 0;
    for (std::size_t i = 0; i < different; ++i) {
        PartDrawing part;
        MOTIONRACK_TRY(part.drawing, drawing_of(job, load, parts.number(i)));
        part.segments = segments_of(part.drawing);
        elements += part.segments.size();
        if (elements > max_elements)
            return fail(ErrorKind::invalid_input,
                        fmt::format("The drawings of {} parts with their numbers have more than {} lines. Nothing was "
                                    "marked; mark fewer parts at once.",
                                    different, max_elements),
                        {}, job.file);
        if (i == 0)
            static_cast<PartDrawing&>(out) = std::move(part);
        else
            out.further.push_back(std::move(part));
    }
    out.bits_per_mm = job.lens ? job.lens->bits_per_mm : job.optics.bits_per_mm;
    if (job.lens) out.lens = job.lens->lens();
    if (job.optics.ct5) {
        MOTIONRACK_TRY(const std::string bytes, load(*job.optics.ct5));
        MOTIONRACK_TRY(
            const rtc5::CorrectionFile file,
            rtc5::read_ct5({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, *job.optics.ct5));
        if (!file.note.empty()) out.notes.push_back(file.note);
        if (job.lens) {
            if (file.bits_per_mm() > 0 && file.bits_per_mm() != out.bits_per_mm)
                out.notes.push_back(
                    fmt::format("{} is made for {:g} bits/mm, the lens for {:g}: the marks have another size.",
                                *job.optics.ct5, file.bits_per_mm(), out.bits_per_mm));
            if (job.optics.correction) out.table = rtc5::table_of(file);
        } else {
            // Without a lens, the bits/mm in the header of the ct5 file apply.
            if (file.bits_per_mm() > 0)
                out.bits_per_mm = file.bits_per_mm();
            else
                out.notes.push_back(fmt::format("{} does not state its bits/mm; {:g} of bits_per_mm are used.",
                                                *job.optics.ct5, out.bits_per_mm));
            out.notes.push_back(fmt::format(
                "The job has no [lens]: the optics are assumed to be those that {} corrects.", *job.optics.ct5));
        }
    } else if (job.lens && job.optics.correction) {
        MOTIONRACK_TRY(const rtc5::CorrectionFile file, rtc5::correction_of(*out.lens));
        out.table = rtc5::table_of(file);
    }
    return out;
}

Result<std::vector<rtc5::Command>> list_of(const MarkingJob& job, const Prepared& prepared,
                                           const ConveyorTracking& following, std::size_t marked) {
    const Drawing& drawing = prepared.of(marked).drawing;
    if (job.fly.wait_mode == WaitMode::none)
        MOTIONRACK_CHECK(check_reaches_field(drawing, prepared.field(), following));
    List list(prepared.bits_per_mm);
    if (job.parts && job.parts->start == PartStart::equidistant && marked + 1 < job.parts->size())
        list.put(Op::simulate_ext_start, {counts_of(job, following, job.parts->spacing), 0});
    put_settings(list, job);
    put_offset(list, job, following);
    put_fly(list, job, prepared, following);
    if (job.fly.wait_mode != WaitMode::none)
        MOTIONRACK_CHECK(put_batches(list, job, prepared, following, drawing));
    else
        for (const Stroke& stroke : drawing.strokes) put_stroke(list, stroke, {}, true);
    list.put(Op::fly_return, {0, 0});
    list.put(Op::set_end_of_list);
    return list.take();
}

Result<std::vector<rtc5::Command>> arming_list_of(const MarkingJob& job, const Prepared& prepared,
                                                  const ConveyorTracking& following) {
    List list(prepared.bits_per_mm);
    put_fly(list, job, prepared, following);
    list.put(Op::fly_return, {0, 0});
    list.put(Op::set_end_of_list);
    return list.take();
}

}  // namespace motionrack::mark
