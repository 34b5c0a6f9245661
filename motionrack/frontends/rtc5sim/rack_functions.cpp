// Additional functions for the cards of a rack: open the rack, read and set its parts.
#include <motionrack/frontends/rtc5sim/calls.hpp>

using namespace motionrack::rtc5sim;
using motionrack::Result;

int rtc5sim_open(const char* rack) {
    return with_bench(__func__, -1, [&](CardTable& bench) -> Result<int> {
        MOTIONRACK_CHECK(check_pointer(rack, "The name of the rack file"));
        MOTIONRACK_CHECK(bench.open_rack(rack));
        return 0;
    });
}

int rtc5sim_close(void) {
    return with_bench(__func__, -1, [](CardTable& bench) -> Result<int> {
        bench.close();
        return 0;
    });
}

int rtc5sim_part_get(const char* part_dot_quantity, double* value) {
    return with_bench(__func__, -1, [&](CardTable& bench) -> Result<int> {
        MOTIONRACK_CHECK(check_pointer(part_dot_quantity, "The name"));
        MOTIONRACK_CHECK(check_pointer(value, "The address of the value"));
        MOTIONRACK_TRY(motionrack::rack::Session * rack, bench.rack());
        MOTIONRACK_TRY(*value, rack->part(part_dot_quantity));
        return 0;
    });
}

int rtc5sim_part_set(const char* part_dot_quantity, double value) {
    return with_bench(__func__, -1, [&](CardTable& bench) -> Result<int> {
        MOTIONRACK_CHECK(check_pointer(part_dot_quantity, "The name"));
        MOTIONRACK_TRY(motionrack::rack::Session * rack, bench.rack());
        MOTIONRACK_CHECK(rack->set_part(part_dot_quantity, value));
        return 0;
    });
}
