// Settings of a card, of a type that its plug-in alone knows.
#pragma once

#include <any>

namespace motionrack::rack {

/// Owns one object of any type that can be copied; a copy of the box has a copy of it.
class SettingsBox {
  public:
    /// The settings; those of a new object if none of this type were stored.
    template <class Settings>
    const Settings& get() const {
        static const Settings defaults{};
        const auto* own = std::any_cast<Settings>(&value_);
        return own != nullptr ? *own : defaults;
    }
    /// The same, to be changed.
    template <class Settings>
    Settings& edit() {
        auto* own = std::any_cast<Settings>(&value_);
        return own != nullptr ? *own : value_.emplace<Settings>();
    }

  private:
    std::any value_;
};

}  // namespace motionrack::rack
