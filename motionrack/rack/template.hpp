// Rack files to start from, written from the same table of keys that the reader uses.
#pragma once

#include <motionrack/base/result.hpp>
#include <span>
#include <string>
#include <string_view>

namespace motionrack::rack {

/// One kind of machine that `motionrack new` can write a rack file for.
struct TemplateVariant {
    std::string_view name;
    std::string_view doc;
};

/// "router", "stage", "single" ..; the first is the default.
std::span<const TemplateVariant> template_variants();

/// A complete rack file: every key with its unit, range and default as a comment. It reads without errors or warnings.
/// Errors: invalid_input if there is no such variant.
Result<std::string> rack_template(std::string_view variant);

}  // namespace motionrack::rack
