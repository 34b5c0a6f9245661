// Millimetres become bits, speeds bits/ms, the belt's movement a scale.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/mark/plan.hpp>

namespace motionrack::mark {

namespace {

using rtc5::Command;
using rtc5::Op;

/// Collects commands; keeps the first error.
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
    /// mm/s to bits/ms. The card would clip it.
    void speed(Op op, const char* name, double mm_s) {
        const double bits_ms = mm_s * k_ / 1000;
        const rtc5::KindInfo range = rtc5::kind_info(rtc5::Kind::speed);
        if (bits_ms < range.least || bits_ms > range.greatest)
            refuse(fmt::format("{} of {:g} mm/s is {:g} bits/ms; the card takes {:g} to {:g}, which is {:g} to {:g} mm/s", name, mm_s, bits_ms, range.least,
                               range.greatest, range.least * 1000 / k_, range.greatest * 1000 / k_));
        put(op, {bits_ms});
    }
    double bits(double mm) {
        const double out = std::floor(mm * k_ + 0.5);
        const rtc5::KindInfo range = rtc5::kind_info(rtc5::Kind::coordinate);
        if (!(out >= range.least && out <= range.greatest))
            refuse(fmt::format("a place at {:g} mm is beyond the card's virtual field of {:g} mm each way", mm, range.greatest / k_));
        return out;
    }
    void refuse(std::string sentence) {
        if (!error_) error_ = Error{Trouble::refused, std::move(sentence) + ". Nothing was marked."};
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
/// A belt along an axis has no share of the other one, to the last bit.
Direction direction_of(const parts::TrackSettings& track) {
    const SinCos d = sin_cos(track.direction_deg * (pi / 180));
    const auto clean = [](double v) { return std::fabs(v) < 1e-12 ? 0.0 : v; };
    return {clean(d.cos), clean(d.sin)};
}

/// What one unit (mm or degree) of movement is in the numbers that the card gets.
double per_unit(const Job& job, const Following& following) {
    switch (following.mode) {
        case FlyMode::encoder: return following.track.counts_per_unit;
        case FlyMode::mcbsp: return job.sender.bits_per_mm;
        default: return following.track.profile[0].speed != 0 ? 1e6 / following.track.profile[0].speed : 0;
    }
}

void put_fly(List& list, const Job& job, const Prepared& prepared, const Following& following) {
    const double unit = per_unit(job, following);
    if (following.mode == FlyMode::off || unit == 0) return;
    const bool words = following.mode == FlyMode::mcbsp;
    if (following.track.rotary) {
        const Spot centre = following.track.centre_mm;
        list.put(Op::set_rot_center_list, {list.bits(centre.x), list.bits(centre.y)});
        const double resolution = 360 * unit / job.fly.scale_factor;
        if (std::fabs(resolution) < rtc5::least_resolution)
            list.refuse(fmt::format("{:g} counts a turn; under {:g} the card's rotary correction is off", resolution, rtc5::least_resolution));
        list.put(words ? Op::set_fly_rot_pos : Op::set_fly_rot, {resolution});
        return;
    }
    const Direction d = direction_of(following.track);
    const double scale = prepared.bits_per_mm * job.fly.scale_factor / unit;
    if (words) {
        if (d.x != 0) list.put(Op::set_fly_x_pos, {scale * (d.y != 0 ? 1 : d.x)});
        if (d.y != 0) list.put(Op::set_fly_y_pos, {scale * (d.x != 0 ? 1 : d.y)});
    } else if (d.x != 0 && d.y != 0) {
        // Both at once, so that neither counter begins a tick later; they are at 0 at the list's begin.
        list.put(Op::activate_fly_xy, {scale * d.x, scale * d.y});
    } else {
        list.put(d.x != 0 ? Op::set_fly_x : Op::set_fly_y, {scale * (d.x != 0 ? d.x : d.y)});
    }
}

}  // namespace

Following following_of(const Job& job, double factor) {
    Following out{job.track(), job.fly.mode};
    for (parts::SpeedPoint& point : out.track.profile) point.speed *= factor;
    return out;
}

Result<Prepared> prepare(const Job& job, const Load& load) {
    Prepared out;
    MOTIONRACK_TRY(out.drawing, drawing_of(job, load));
    out.segments = segments_of(out.drawing);
    out.bits_per_mm = job.lens ? job.lens->bits_per_mm : job.optics.bits_per_mm;
    if (job.lens) out.lens = job.lens->lens();
    if (job.optics.ct5) {
        MOTIONRACK_TRY(const std::string bytes, load(*job.optics.ct5));
        MOTIONRACK_TRY(const rtc5::CorrectionFile file,
                       rtc5::read_ct5({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, *job.optics.ct5));
        if (!file.checksum_known) out.notes.push_back(fmt::format("{} is of an older program, whose checksum is not known; it was not checked.", *job.optics.ct5));
        if (job.lens) {
            if (file.bits_per_mm() > 0 && file.bits_per_mm() != out.bits_per_mm)
                out.notes.push_back(fmt::format("{} is made for {:g} bits/mm, the lens for {:g}: what is marked has another size.", *job.optics.ct5, file.bits_per_mm(), out.bits_per_mm));
            if (job.optics.correction) out.table = rtc5::table_of(file);
        } else {
            // Without a lens the field behind the table is the one that it is made for.
            if (file.bits_per_mm() > 0) out.bits_per_mm = file.bits_per_mm();
            out.notes.push_back(fmt::format("There is no [lens]: the optics are taken to be those that {} corrects.", *job.optics.ct5));
        }
    } else if (job.lens && job.optics.correction) {
        MOTIONRACK_TRY(const rtc5::CorrectionFile file, rtc5::correction_of(*out.lens));
        out.table = rtc5::table_of(file);
    }
    return out;
}

Result<std::vector<rtc5::Command>> list_of(const Job& job, const Prepared& prepared, const Following& following) {
    List list(prepared.bits_per_mm);
    list.speed(Op::set_jump_speed, "A jump speed", job.pace.jump_mm_s);
    list.speed(Op::set_mark_speed, "A mark speed", job.pace.mark_mm_s);
    list.put(Op::set_scanner_delays, {job.pace.jump_delay_us / 10, job.pace.mark_delay_us / 10, job.pace.polygon_delay_us / 10});
    list.put(Op::set_laser_delays, {job.pace.laser_on_us * 2, job.pace.laser_off_us * 2});
    put_fly(list, job, prepared, following);
    for (const Stroke& stroke : prepared.drawing.strokes) {
        list.put(Op::jump_abs, {list.bits(stroke.from.x), list.bits(stroke.from.y)});
        for (const Element& e : stroke.elements) {
            if (e.sweep == 0)
                list.put(Op::mark_abs, {list.bits(e.to.x), list.bits(e.to.y)});
            else
                list.put(Op::arc_abs, {list.bits(e.centre.x), list.bits(e.centre.y), -e.sweep * (180 / pi)});
        }
    }
    list.put(Op::fly_return, {0, 0});
    list.put(Op::set_end_of_list);
    return list.take();
}

}  // namespace motionrack::mark
