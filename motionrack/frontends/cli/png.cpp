// PNG output uses a module that is loaded for the first picture.
#include <dlfcn.h>
#include <fmt/format.h>
#include <motionrack/frontends/png/png.h>

#include <filesystem>
#include <motionrack/frontends/cli/png.hpp>
#include <vector>

namespace motionrack::cli {

namespace {

tl::unexpected<Error> not_drawn(std::string_view why) {
    return fail(ErrorKind::io, fmt::format("The picture could not be drawn as PNG: {}. Write it as SVG.", why));
}

/// Loads the module beside this program, installed or built; it stays loaded.
Result<decltype(&motionrack_png_of)> load_module() {
    namespace fs = std::filesystem;
    std::error_code error;
    const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
    std::string why = "its module png.so was not found";
    for (const char* place : {MOTIONRACK_MODULES, "../lib/motionrack"}) {
        const fs::path path = folder / place / "png.so";
        if (error || !fs::exists(path, error)) continue;
        if (void* const module = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL); module != nullptr)
            if (void* const found = ::dlsym(module, "motionrack_png_of"); found != nullptr)
                return reinterpret_cast<decltype(&motionrack_png_of)>(found);
        if (const char* const said = ::dlerror(); said != nullptr) why = said;
    }
    return not_drawn(why);
}

}  // namespace

Result<std::string> png_of(std::string_view svg, double scale) {
    MOTIONRACK_TRY(const auto draw, load_module());
    std::string out;
    const auto take = [](void* to, const char* bytes, std::size_t size) {
        static_cast<std::string*>(to)->assign(bytes, size);
    };
    if (draw(svg.data(), svg.size(), scale, take, &out) == 0) return not_drawn(out);
    return out;
}

}  // namespace motionrack::cli
