// Combines the files and texts of a job into one drawing in the field.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <motionrack/base/trig.hpp>
#include <motionrack/mark/gcode_drawing.hpp>
#include <motionrack/mark/marking_job.hpp>
#include <motionrack/mark/stroke_font.hpp>
#include <motionrack/mark/svg.hpp>

namespace motionrack::mark {

namespace {

constexpr std::size_t max_segments = 5'000'000;
constexpr double max_mm = 1e5;

Result<void> check_size(const Drawing& drawing, const std::string& file) {
    if (element_count(drawing) > max_elements || segment_count(drawing) > max_segments)
        return fail(
            ErrorKind::invalid_input,
            fmt::format(
                "The drawing has more than {} lines and arcs, or more than {} with arcs as lines. Nothing was marked.",
                max_elements, max_segments),
            {}, file);
    const auto near = [](Spot p) { return std::fabs(p.x) <= max_mm && std::fabs(p.y) <= max_mm; };
    for (const Stroke& stroke : drawing.strokes) {
        bool good = near(stroke.from);
        for (const Element& e : stroke.elements) good &= near(e.to) && near(e.centre);
        if (!good)
            return fail(ErrorKind::invalid_input,
                        fmt::format("A part of the drawing, or the centre of an arc, is more than {:g} mm from the "
                                    "field's middle. Nothing was marked; make it smaller.",
                                    max_mm),
                        {}, file);
    }
    return {};
}

/// Returns the drawing of one source, transformed into the field.
Result<Drawing> source_drawing(const DrawingSource& source, const std::string& file, const Load& load,
                               std::int64_t number) {
    Drawing drawing;
    if (source.text) {
        const auto text = numbered(*source.text, number);
        if (!text) return fail(text.error().kind, text.error().message, {}, file);
        auto made = text_drawing(*text, source.height_mm);
        if (!made) return fail(made.error().kind, made.error().message, {}, file);
        drawing = std::move(*made);
    } else {
        const std::string& name = source.svg ? *source.svg : *source.gcode;
        MOTIONRACK_TRY(const std::string text, load(name));
        MOTIONRACK_TRY(drawing, source.svg ? read_svg(text, name, source.tolerance_mm) : read_gcode(text, name));
    }
    if (element_count(drawing) == 0)
        return fail(ErrorKind::invalid_input, "The drawing has no lines. Nothing was marked.", {}, file);
    MOTIONRACK_CHECK(check_size(drawing, file));
    const Box box = box_of(drawing);
    double scale = source.scale;
    if (source.width_mm) {
        const double wide = box.high.x - box.low.x;
        if (!(wide > 0))
            return fail(ErrorKind::invalid_input,
                        "The drawing is 0 mm wide and cannot be made as wide as width_mm. Nothing was marked.", {},
                        file);
        scale *= *source.width_mm / wide;
    }
    if (source.svg && scale > 1) {  // the tolerance applies to the part
        MOTIONRACK_TRY(const std::string text, load(*source.svg));
        MOTIONRACK_TRY(drawing, read_svg(text, *source.svg, source.tolerance_mm / scale));
    }
    const SinCos turn = sin_cos(source.rotate_deg * (pi / 180));
    const Spot anchor =
        source.anchor == Anchor::centre ? Spot{(box.low.x + box.high.x) / 2, (box.low.y + box.high.y) / 2} : Spot{};
    const Affine place =
        Affine{scale * turn.cos, scale * turn.sin, -scale * turn.sin, scale * turn.cos, source.x_mm, source.y_mm}.after(
            {1, 0, 0, 1, -anchor.x, -anchor.y});
    Drawing out = transformed(drawing, place, source.tolerance_mm);
    MOTIONRACK_CHECK(check_size(out, file));
    return out;
}

}  // namespace

bool has_numbers(const MarkingJob& job) {
    return std::any_of(job.drawings.begin(), job.drawings.end(),
                       [](const DrawingSource& d) { return d.text && d.text->find('{') != std::string::npos; });
}

Result<Drawing> drawing_of(const MarkingJob& job, const Load& load, std::int64_t number) {
    Drawing out;
    for (const DrawingSource& source : job.drawings) {
        MOTIONRACK_TRY(Drawing one, source_drawing(source, job.file, load, number));
        std::move(one.strokes.begin(), one.strokes.end(), std::back_inserter(out.strokes));
    }
    if (job.drawings.size() > 1) MOTIONRACK_CHECK(check_size(out, job.file));
    return out;
}

}  // namespace motionrack::mark
