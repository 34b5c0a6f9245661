// Settings of a card, of a type that its plug-in alone knows.
#pragma once

#include <any>

namespace motionrack::rack {

/// Owns one object of any type that can be copied; a copy of the box has a copy of it.
class SettingsBox {
  public:
    /// Returns the stored settings; default ones if none of this type are stored.
    template <class Settings>
    const Settings& get() const {
        static const Settings defaults{};
        const auto* own = std::any_cast<Settings>(&value_);
        return own != nullptr ? *own : defaults;
    }
    /// Returns the stored settings for changing; stores default ones if none of this type are stored.
    template <class Settings>
    Settings& edit() {
        auto* own = std::any_cast<Settings>(&value_);
        return own != nullptr ? *own : value_.emplace<Settings>();
    }

  private:
    std::any value_;
};

}  // namespace motionrack::rack
