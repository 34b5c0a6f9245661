// Draws with librsvg on a cairo surface. A separate module, because these libraries and their dependencies are half of
// all that the program would load at start.
#include <cairo.h>
#include <librsvg/rsvg.h>
#include <motionrack/frontends/png/png.h>

#include <cmath>
#include <memory>
#include <motionrack/base/result.hpp>
#include <string>
#include <string_view>
#include <utility>

namespace motionrack::png {

namespace {

template <auto Function>
struct By {
    template <class T>
    void operator()(T* p) const {
        Function(p);
    }
};

tl::unexpected<Error> not_drawn(std::string why) {
    return fail(ErrorKind::io, std::move(why));
}

std::string taken(GError* error) {
    std::string text = error != nullptr ? error->message : "unknown error";
    g_clear_error(&error);
    return text;
}

cairo_status_t append(void* to, const unsigned char* bytes, unsigned int count) {
    static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(bytes), count);
    return CAIRO_STATUS_SUCCESS;
}

Result<std::string> png_of(std::string_view svg, double scale) {
    GError* error = nullptr;
    const std::unique_ptr<GInputStream, By<g_object_unref>> stream(
        g_memory_input_stream_new_from_data(svg.data(), static_cast<gssize>(svg.size()), nullptr));
    // Unlimited, because long paths have long attributes.
    const std::unique_ptr<RsvgHandle, By<g_object_unref>> handle(
        rsvg_handle_new_from_stream_sync(stream.get(), nullptr, RSVG_HANDLE_FLAG_UNLIMITED, nullptr, &error));
    if (!handle) return not_drawn(taken(error));
    gboolean has_width = 0, has_height = 0, has_box = 0;
    RsvgLength width, height;
    RsvgRectangle box{};
    rsvg_handle_get_intrinsic_dimensions(handle.get(), &has_width, &width, &has_height, &height, &has_box, &box);
    if (!has_box) return not_drawn("it has no viewBox");
    const RsvgRectangle whole{0, 0, box.width * scale, box.height * scale};
    const std::unique_ptr<cairo_surface_t, By<cairo_surface_destroy>> surface(cairo_image_surface_create(
        CAIRO_FORMAT_RGB24, static_cast<int>(std::ceil(whole.width)), static_cast<int>(std::ceil(whole.height))));
    const std::unique_ptr<cairo_t, By<cairo_destroy>> pen(cairo_create(surface.get()));
    if (!rsvg_handle_render_document(handle.get(), pen.get(), &whole, &error)) return not_drawn(taken(error));
    std::string bytes;
    const cairo_status_t status = cairo_surface_write_to_png_stream(surface.get(), append, &bytes);
    if (status != CAIRO_STATUS_SUCCESS) return not_drawn(cairo_status_to_string(status));
    return bytes;
}

}  // namespace

}  // namespace motionrack::png

int motionrack_png_of(const char* svg, size_t size, double scale, void (*take)(void*, const char*, size_t), void* to) {
    const motionrack::Result<std::string> bytes = motionrack::png::png_of({svg, size}, scale);
    const std::string& out = bytes ? *bytes : bytes.error().message;
    take(to, out.data(), out.size());
    return bytes ? 1 : 0;
}
