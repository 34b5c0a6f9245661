// A part whose quantities are the rows of one table. Only the files of parts (*_part.cpp) use it.
#pragma once

#include <motionrack/rack/part.hpp>
#include <motionrack/rack/part_catalogue.hpp>
#include <motionrack/rack/toml_reader.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace motionrack::rack {

/// A row of the table of a kind of part. `Running`: its struct in the running rack.
template <class Running>
struct QuantityRow {
    std::string_view name;  ///< "{u}" stands for mm or deg
    std::string_view doc;
    double (*get)(Running& running, Instant now);
    ValueKind values;
    bool (*present)(const Running& running) = nullptr;  ///< nullptr: always
};

template <class Running>
class TablePart : public Part {
  public:
    /// `unit`: in the names of the quantities. `running` stays where it is as long as the rack exists.
    TablePart(std::string name, std::string_view unit, Running& running, std::span<const QuantityRow<Running>> rows)
        : running_(running), name_(std::move(name)), unit_(unit), rows_(rows) {}

    const std::string& name() const final { return name_; }
    std::vector<Quantity> quantities() final {
        std::vector<Quantity> out;
        for (const QuantityRow<Running>& row : rows_)
            if (has(row))
                out.push_back({with_unit(row.name, unit_), row.doc, row.values,
                               [&running = running_, get = row.get](Instant now) { return get(running, now); }});
        return out;
    }
    std::optional<double> quantity(std::string_view quantity_name, Instant now) final {
        for (const QuantityRow<Running>& row : rows_)
            if (has(row) && with_unit(row.name, unit_) == quantity_name) return row.get(running_, now);
        return std::nullopt;
    }

  protected:
    Running& running_;

  private:
    bool has(const QuantityRow<Running>& row) const { return row.present == nullptr || row.present(running_); }

    std::string name_;
    std::string_view unit_;
    std::span<const QuantityRow<Running>> rows_;
};

/// Names and descriptions of a table's rows.
template <const auto& rows>
std::vector<DeclaredQuantity> declared() {
    std::vector<DeclaredQuantity> out;
    for (const auto& row : rows) out.push_back({row.name, row.doc});
    return out;
}

}  // namespace motionrack::rack
