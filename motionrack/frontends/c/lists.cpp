// Implements mr_quantities and mr_faults of motionrack/c.h.
#include <motionrack/frontends/c/calls.hpp>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/quantities.hpp>

namespace {

using namespace motionrack::c;
using motionrack::Result;
using motionrack::rack::FaultValue;
using motionrack::rack::QuantityRange;

}  // namespace

int mr_quantities(mr_rack* rack, void (*tell)(void* user, const mr_quantity* quantity), void* user) {
    return guarded({{rack, no_rack}, {reinterpret_cast<const void*>(tell), no_tell}}, [&]() -> Result<void> {
        for (const QuantityRange& one : motionrack::rack::quantity_ranges(rack->session->rack())) {
            const std::string meaning(one.doc), unit(one.unit);
            const mr_quantity quantity{one.name.c_str(), meaning.c_str(), unit.c_str(), one.min, one.max, one.can_set};
            tell(user, &quantity);
        }
        return {};
    });
}

int mr_faults(mr_rack* rack, void (*tell)(void* user, const mr_fault_info* fault), void* user) {
    return guarded({{rack, no_rack}, {reinterpret_cast<const void*>(tell), no_tell}}, [&]() -> Result<void> {
        for (const FaultValue& one : motionrack::rack::fault_values(rack->session->rack())) {
            const std::string name(one.name), meaning(one.doc);
            const mr_fault_info fault{name.c_str(), one.target.c_str(), meaning.c_str(), one.unit.c_str(), one.min,
                                      one.max};
            tell(user, &fault);
        }
        return {};
    });
}
