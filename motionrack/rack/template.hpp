// Template rack files, written from the reader's table of keys.
#pragma once

#include <motionrack/base/result.hpp>
#include <span>
#include <string>
#include <string_view>

namespace motionrack::rack {

/// A kind of machine for which `motionrack new` can write a rack file.
struct TemplateVariant {
    std::string_view name;
    std::string_view doc;
};

/// "router", "stage", "single" ..; the first is the default.
std::span<const TemplateVariant> template_variants();

/// Returns a complete rack file: every key with its unit, range and default as a comment. Reads without errors or
/// warnings. Errors: invalid_input for an unknown variant.
Result<std::string> rack_template(std::string_view variant);

}  // namespace motionrack::rack
