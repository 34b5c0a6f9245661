// Assigns marks to the part whose list was running.
#include <algorithm>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/mark/parts_marked.hpp>

namespace motionrack::mark {

namespace {

double seconds(std::int64_t tick) {
    return static_cast<double>(tick) * 1e-5;
}

/// Returns the signed belt distance until the part reaches its marking position.
double travel_of(const MarkingJob& job, std::size_t part) {
    return job.parts ? job.parts->travel(part) * job.sense() : 0;
}

PartOutcome fate_of(rtc5::StartFate fate) {
    switch (fate) {
        case rtc5::StartFate::begun:
            return PartOutcome::marked;
        case rtc5::StartFate::busy:
            return PartOutcome::lost_busy;
        default:
            return PartOutcome::lost_too_many;
    }
}

/// Returns the transform from the coordinates of a part to those of the pictures.
Affine shown_place(const MarkingJob& job, const Prepared& prepared, const parts::Conveyor& track, std::size_t part) {
    if (!job.parts || part == 0) return {};
    if (track.settings().rotary) {
        const double turn = (travel_of(job, 0) - travel_of(job, part)) * (pi / 180);
        const SinCos t = sin_cos(turn);
        const Spot c = track.settings().centre_mm;
        return Affine{1, 0, 0, 1, c.x, c.y}.after({t.cos, t.sin, -t.sin, t.cos, 0, 0}).after({1, 0, 0, 1, -c.x, -c.y});
    }
    // Each later part is drawn behind the previous one against the movement, with a gap of a quarter of the part
    // length.
    const Spot forward = track.carried({}, job.sense());
    double low = 0, high = 0;
    const Box box = box_of(prepared.drawing);
    bool first = true;
    for (const Spot corner : {box.low, box.high, Spot{box.low.x, box.high.y}, Spot{box.high.x, box.low.y}}) {
        const double along = corner.x * forward.x + corner.y * forward.y;
        low = first ? along : std::min(low, along), high = first ? along : std::max(high, along);
        first = false;
    }
    const double back = -1.25 * (high - low) * static_cast<double>(part);
    return {1, 0, 0, 1, forward.x * back, forward.y * back};
}

parts::Deviation together(const std::vector<PartMarked>& all) {
    if (all.size() == 1) return all[0].deviation;
    parts::Deviation out;
    double length = 0, squares = 0;
    for (const PartMarked& part : all) {
        const parts::Deviation& d = part.deviation;
        if (d.max_mm > out.max_mm) out.max_mm = d.max_mm, out.max_at = d.max_at, out.max_s = d.max_s;
        out.missing_mm += d.missing_mm;
        length += part.marked_mm;
        squares += d.rms_mm * d.rms_mm * part.marked_mm;
    }
    if (length > 0) out.rms_mm = std::sqrt(squares / length);
    return out;
}

}  // namespace

void share_out(const MarkingJob& job, const Prepared& prepared, const std::vector<PartRun>& runs,
               const parts::Conveyor& track, std::span<const parts::MarkedPoint> points, Marked& out) {
    const auto own_place = [&](Spot belt, double travel) { return travel == 0 ? belt : track.carried(belt, travel); };
    PartMarked none;
    none.fate = PartOutcome::not_started;
    out.parts.assign(job.parts ? job.parts->size() : 1, none);
    std::vector<PartRun> begun;
    for (const PartRun& run : runs) {
        PartMarked& part = out.parts[run.part];
        part.fate = fate_of(run.fate);
        part.begin_s = seconds(run.begin), part.end_s = seconds(run.end);
        part.drawing = std::min(begun.size(), prepared.further.size());  // the drawing that a lost part would have got
        if (run.fate != rtc5::StartFate::begun) continue;
        part.drawing = run.marked;
        part.number = job.parts.value_or(PartsSettings{}).number(run.marked);
        begun.push_back(run);
    }
    std::size_t at = 0;
    for (std::size_t i = 0; i < begun.size(); ++i) {
        PartMarked& part = out.parts[begun[i].part];
        const double until = i + 1 < begun.size() ? seconds(begun[i + 1].begin) : 1e300;
        const double travel = travel_of(job, begun[i].part);
        part.first_point = at;
        for (; at < points.size() && points[at].begun_s < until; ++at) {
            parts::MarkedPoint own = points[at];
            own.at = own_place(own.at, travel);
            if (!own.first && out.points.size() > part.first_point) {
                const Spot before = out.points.back().at;
                part.marked_mm += std::sqrt((own.at.x - before.x) * (own.at.x - before.x) +
                                            (own.at.y - before.y) * (own.at.y - before.y));
            }
            out.points.push_back(own);
        }
        part.points = at - part.first_point;
        for (Overflow& o : out.overflows)
            if (o.from_s >= part.begin_s && o.from_s < until)
                o.part_no = begun[i].part, o.part = own_place(o.part, travel);
    }
    for (std::size_t i = 0; i < out.parts.size(); ++i) out.parts[i].shown = shown_place(job, prepared, track, i);
    for (PartMarked& part : out.parts)
        part.deviation = parts::compare(std::span(out.points).subspan(part.first_point, part.points),
                                        prepared.of(part.drawing).segments);
    out.deviation = together(out.parts);
}

}  // namespace motionrack::mark
