// Driver functions named in its messages, and their names in the function library, which has plain numbers as
// arguments: in C with the prefix mcx314_.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace motionrack::mcx314 {

struct OwnName {
    std::string_view driver, library;
};
/// Names of functions. Of two names with the same beginning, the longer one comes first, so that it is replaced first.
inline constexpr std::array own_names = {
    OwnName{"ContStart", "contour_begin"},    OwnName{"ContLine", "contour_line"},
    OwnName{"ContArc", "contour_arc"},        OwnName{"ContEnd", "contour_end"},
    OwnName{"BP2D or BP3D", "pattern_begin"}, OwnName{"BP2D", "pattern_begin"},
    OwnName{"BP3D", "pattern_begin"},         OwnName{"BPStack", "pattern_steps"},
    OwnName{"BPStart", "pattern_start"},      OwnName{"BPEnd", "pattern_end"},
    OwnName{"SetOutput", "set_output"},
};

/// Replaces the names in a message of the Driver by those of the library, each with `prefix`.
inline std::string with_own_names(std::string_view sentence, std::string_view prefix) {
    std::string out(sentence);
    for (const OwnName& name : own_names)
        for (std::size_t at = 0; (at = out.find(name.driver, at)) != std::string::npos;) {
            out.replace(at, name.driver.size(), name.library);
            out.insert(at, prefix);
            at += prefix.size() + name.library.size();
        }
    return out;
}

}  // namespace motionrack::mcx314
