// Tables of states that run: which row an event executes, and the compile-time comparison with the declared machine.
#include <gtest/gtest.h>

#include <motionrack/base/states.hpp>
#include <string>

namespace motionrack {
namespace {

enum class Door : std::uint8_t { closed, open, locked };
enum class DoorEvent : std::uint8_t { push, key, slam };

struct DoorKeeper {
    Door door = Door::closed;
    int tries = 0;
    std::string said = {};
};

bool key_fits(const DoorKeeper&, int key) {
    return key == 7;
}
void count_try(DoorKeeper& keeper, int) {
    ++keeper.tries;
}
void say_state(DoorKeeper& keeper, int key) {
    keeper.said += std::to_string(static_cast<int>(keeper.door)) + "/" + std::to_string(key) + " ";
}

using DoorRow = StateRow<DoorKeeper, Door, DoorEvent, int>;
constexpr DoorRow door_rows[] = {
    {Door::closed, DoorEvent::push, Door::open},
    {Door::closed, DoorEvent::key, Door::locked, key_fits, say_state},
    {Door::closed, DoorEvent::key, Door::closed, nullptr, count_try},
    {Door::locked, DoorEvent::key, Door::closed, key_fits, say_state},
    {Door::locked, DoorEvent::key, Door::locked, nullptr, count_try},
    {Door::open, DoorEvent::slam, Door::closed, nullptr, say_state},
};

constexpr StateInfo door_states[] = {{"closed", "shut"}, {"open", "not shut"}, {"locked", "shut, with the key"}};
constexpr TransitionInfo door_transitions[] = {
    {"closed", "open", "a push"},
    {"closed", "locked", "the key"},
    {"locked", "closed", "the key"},
    {"open", "closed", "a slam"},
};
constexpr MachineInfo door_machine = {"door", "a door", door_states, door_transitions};
static_assert(declared<rows_flaw(door_machine, door_rows)>());

TEST(StateRows, ExecuteTheFirstRowForTheEventWhoseGuardHolds) {
    DoorKeeper keeper;
    EXPECT_TRUE(step(door_rows, keeper.door, DoorEvent::key, keeper, 3));
    EXPECT_EQ(keeper.door, Door::closed);
    EXPECT_EQ(keeper.tries, 1);
    EXPECT_TRUE(step(door_rows, keeper.door, DoorEvent::key, keeper, 7));
    EXPECT_EQ(keeper.door, Door::locked);
    EXPECT_EQ(keeper.tries, 1);
}

TEST(StateRows, LeaveTheStateAndTellWhereAnEventHasNoRow) {
    DoorKeeper keeper;
    EXPECT_FALSE(step(door_rows, keeper.door, DoorEvent::slam, keeper, 0));
    EXPECT_EQ(keeper.door, Door::closed);
    keeper.door = Door::locked;
    EXPECT_FALSE(step(door_rows, keeper.door, DoorEvent::push, keeper, 0));
    EXPECT_EQ(keeper.door, Door::locked);
    EXPECT_EQ(keeper.said, "");
}

TEST(StateRows, RunAnActionInTheNewStateWithTheDataOfTheEvent) {
    DoorKeeper keeper{Door::open};
    EXPECT_TRUE(step(door_rows, keeper.door, DoorEvent::slam, keeper, 5));
    EXPECT_TRUE(step(door_rows, keeper.door, DoorEvent::key, keeper, 7));
    EXPECT_EQ(keeper.said, "0/5 2/7 ");
}

TEST(StateRows, StoreAStateThatIsKeptInAnotherForm) {
    DoorKeeper keeper;
    int bits = 0;
    EXPECT_TRUE(step(door_rows, Door::closed, DoorEvent::push, keeper, 0, [&](Door to) { bits = 1 << int(to); }));
    EXPECT_EQ(bits, 2);
    EXPECT_EQ(keeper.door, Door::closed);
}

TEST(StateRows, AreComparedWithTheDeclaredTransitions) {
    const auto flaw_of = [](std::span<const TransitionInfo> transitions) {
        return std::string(rows_flaw({"door", "a door", door_states, transitions}, door_rows).text());
    };
    EXPECT_EQ(flaw_of(door_transitions), "");
    EXPECT_EQ(flaw_of(std::span(door_transitions).first(3)),
              "door: a row, but no declared transition, leads from open to closed");
    const TransitionInfo more[] = {door_transitions[0],
                                   door_transitions[1],
                                   door_transitions[2],
                                   door_transitions[3],
                                   {"open", "locked", "magic"}};
    EXPECT_EQ(flaw_of(more), "door: no row leads from open to locked");
    const TransitionInfo staying[] = {door_transitions[0],
                                      door_transitions[1],
                                      door_transitions[2],
                                      door_transitions[3],
                                      {"open", "open", "a draught"}};
    EXPECT_EQ(flaw_of(staying), "") << "a state that stays is not a way";
    EXPECT_EQ(std::string(rows_flaw({"door", "a door", std::span(door_states).first(2), {}}, door_rows).text()),
              "door: a row has a state that is not declared");
}

}  // namespace
}  // namespace motionrack
