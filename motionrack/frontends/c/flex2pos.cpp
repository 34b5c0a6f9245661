// Implements motionrack/flex2pos.h with the function library of the IOFLEX02.
#include <fmt/format.h>
#include <motionrack/flex2pos.h>

#include <algorithm>
#include <array>
#include <motionrack/cards/ioflex02/driver/flex2pos.hpp>
#include <motionrack/frontends/c/calls.hpp>
#include <motionrack/frontends/c/session_host.hpp>
#include <motionrack/rack/ioflex02_card.hpp>
#include <motionrack/rack/raised_flag.hpp>
#include <type_traits>
#include <vector>

namespace io = motionrack::ioflex02;
using namespace motionrack::c;

static_assert(int{Flex_Ok} == int{io::Flex_Ok} && int{Flex_ErrCfg} == int{io::Flex_ErrCfg} &&
              int{Flex_ErrDevice} == int{io::Flex_ErrDevice} && int{Flex_ErrProject} == int{io::Flex_ErrProject});
static_assert(cNop == static_cast<int>(io::cNop) && cRes == static_cast<int>(io::cRes) &&
              cResNm == static_cast<int>(io::cResNm) && cResNmSig == static_cast<int>(io::cResNmSig));

static_assert(cVerNo == int{io::cVerNo} && sizeof cVer == sizeof io::cVer);
static_assert(flex2pos_payload == io::min_payload);

namespace motionrack::c {

/// The bus of the IOFLEX02 cards, on which a program may also access addresses without a card.
class FlexPort final : public RegisterPort, public SessionHost {
  public:
    FlexPort(rack::Session& session, rack::Card& card) : SessionHost(session, card.name()), port_(*card.port()) {}
    void write(std::uint32_t offset, std::uint16_t value) override {
        port_.write(offset, value);
        session_.after_access();
    }
    std::uint16_t read(std::uint32_t offset) override {
        const std::uint16_t value = port_.read(offset);
        session_.after_access();
        return value;
    }

  private:
    RegisterPort& port_;
};

}  // namespace motionrack::c

struct flex2pos {
    flex2pos(motionrack::rack::Session& of, motionrack::rack::Card& card)
        : session(of), config(of.rack().config()), port(of, card), library(port, port) {}
    const motionrack::rack::Session& session;    ///< must outlive the object
    const motionrack::rack::RackConfig& config;  ///< configuration of its rack
    FlexPort port;
    io::Flex2Pos library;
    bool is_running = false;  ///< the library is running, perhaps around a call-back of the rack
};

namespace {
constexpr const char* no_object = "The object is a null pointer; open one with flex2pos_open. Nothing was done.";

/// Stores the sentence of an error during a call, if any.
void report(const FlexPort& port) {
    if (port.error()) failed(code_of(port.error()->kind), port.error()->message);
}

/// Returns the value of `call`. Returns 0 and stores the error for a null object, inside a callback of its rack, or if
/// out of memory.
template <class Call>
auto with(flex2pos* flex, Call call) noexcept -> decltype(call(flex->library)) {
    using Value = decltype(call(flex->library));
    if (flex == nullptr) {
        failed(MR_BAD_CALL, no_object);
        return Value();
    }
    try {
        if (const auto free = flex->session.check_free(); !free) {
            failed(MR_REFUSED, free.error().message);
            return Value();
        }
        const motionrack::rack::RaisedFlag running(flex->is_running);
        flex->port.forget_error();
        if constexpr (std::is_void_v<Value>) {
            call(flex->library);
            report(flex->port);
        } else {
            const Value value = call(flex->library);
            report(flex->port);
            return value;
        }
    } catch (...) {
        failed(MR_INTERNAL, "Not enough memory; the call was not finished.");
        return Value();
    }
}

}  // namespace

extern "C" {
int flex2pos_open(mr_rack* rack, flex2pos** flex) {
    if (flex != nullptr) *flex = nullptr;
    return guarded({{rack, no_rack}, {flex, "The pointer to the object is null. Nothing was done."}},
                   [&]() -> motionrack::Result<void> {
                       for (const auto& card : rack->session->rack().cards()) {
                           if (card->map().name != io::card_map().name) continue;
                           *flex = new flex2pos(*rack->session, *card);
                           return {};
                       }
                       return motionrack::fail(motionrack::ErrorKind::invalid_input,
                                               "The rack has no card of type ioflex02. Nothing was done.");
                   });
}

void flex2pos_close(flex2pos* flex) {
    if (flex != nullptr && flex->is_running) {
        failed(MR_REFUSED, "The object is running a call, around this call-back. It was not closed; return first.");
        return;
    }
    delete flex;
}

int flex2pos_Init(flex2pos* flex, uint16_t Addr) {
    if (flex == nullptr) return failed(MR_BAD_CALL, no_object), Flex_ErrDevice;
    int outcome = Flex_ErrDevice;  // unless the call was made
    with(flex, [&](io::Flex2Pos& library) {
        library.use_image(motionrack::rack::ioflex02_image_at(flex->config, Addr));
        library.Init(Addr);
        outcome = library.Result;
    });
    return outcome;
}

int flex2pos_set_base_address(flex2pos* flex, uint16_t Addr) {
    return guarded({{flex, no_object}}, [&]() -> motionrack::Result<void> {
        MOTIONRACK_CHECK(flex->session.check_free());
        flex->library.Flex02::Init(Addr);
        return {};
    });
}

int flex2pos_Configure(flex2pos* flex, const uint8_t* image, size_t size) {
    if (flex == nullptr) return failed(MR_BAD_CALL, no_object), Flex_ErrDevice;
    int outcome = Flex_ErrDevice;  // unless the call was made
    with(flex, [&](io::Flex2Pos& library) {
        if (image != nullptr) {
            library.Configure({image, size});
        } else {
            const auto own = motionrack::rack::ioflex02_image_at(flex->config, library.base_address());
            library.Configure(own.empty() ? io::position_image() : own);
        }
        outcome = library.Result;
    });
    return outcome;
}

int flex2pos_Result(const flex2pos* flex) {
    return flex != nullptr ? flex->library.Result : Flex_ErrDevice;
}
const char* flex2pos_why(const flex2pos* flex) {
    return flex != nullptr ? flex->library.why().c_str() : no_object;
}

uint8_t flex2pos_GetIdent(flex2pos* flex) {
    return with(flex, [](io::Flex2Pos& library) { return library.GetIdent(); });
}

int32_t flex2pos_ReadTime(flex2pos* flex) {
    return with(flex, [](io::Flex2Pos& library) { return library.ReadTime(); });
}

int32_t flex2pos_ReadTimeClr(flex2pos* flex) {
    return with(flex, [](io::Flex2Pos& library) { return library.ReadTimeClr(); });
}

int32_t flex2pos_ReadPosition(flex2pos* flex, int axis) {
    return with(flex, [&](io::Flex2Pos& library) {
        switch (axis) {
            case 0:
                return library.ReadPosition0();
            case 1:
                return library.ReadPosition1();
            case 2:
                return library.ReadPosition2();
            case 3:
                return library.ReadPosition3();
            default:
                return failed(MR_BAD_CALL, fmt::format("Axis {} must be 0 to 3. Nothing was done.", axis)), int32_t{0};
        }
    });
}

void flex2pos_ReadTimeClrPosition(flex2pos* flex, int32_t* Time, int32_t Pos[4]) {
    int32_t time = 0;
    std::array<int32_t, 4> at{};
    with(flex, [&](io::Flex2Pos& library) { library.ReadTimeClrPosition(time, at[0], at[1], at[2], at[3]); });
    if (Time != nullptr) *Time = time;
    if (Pos != nullptr) std::copy(at.begin(), at.end(), Pos);
}

void flex2pos_WriteOutL(flex2pos* flex, uint8_t Data) {
    with(flex, [&](io::Flex2Pos& library) { library.WriteOutL(Data); });
}

void flex2pos_WriteOutH(flex2pos* flex, uint8_t Data) {
    with(flex, [&](io::Flex2Pos& library) { library.WriteOutH(Data); });
}

uint8_t flex2pos_ReadInL(flex2pos* flex) {
    return with(flex, [](io::Flex2Pos& library) { return library.ReadInL(); });
}

uint8_t flex2pos_ReadInH(flex2pos* flex) {
    return with(flex, [](io::Flex2Pos& library) { return library.ReadInH(); });
}

void flex2pos_WriteCmd(flex2pos* flex, int Cmd0, int Cmd1, int Cmd2, int Cmd3) {
    with(flex, [&](io::Flex2Pos& library) {
        for (const int command : {Cmd0, Cmd1, Cmd2, Cmd3})
            if (command < cNop || command > cResNmSig) {
                failed(MR_BAD_CALL,
                       fmt::format("Calibration command {} must be 0 to 3. Nothing was written.", command));
                return;
            }
        library.WriteCmd(static_cast<io::tIOFlexCmd>(Cmd0), static_cast<io::tIOFlexCmd>(Cmd1),
                         static_cast<io::tIOFlexCmd>(Cmd2), static_cast<io::tIOFlexCmd>(Cmd3));
    });
}

void flex2pos_WriteCmdAxis(flex2pos* flex, int axis, int Cmd) {
    with(flex, [&](io::Flex2Pos& library) {
        if (axis < 0 || axis >= io::axis_count || Cmd < cNop || Cmd > cResNmSig) {
            failed(MR_BAD_CALL,
                   fmt::format("Axis {} and command {} must both be 0 to 3. Nothing was written.", axis, Cmd));
            return;
        }
        library.WriteCmdAxis(axis, static_cast<io::tIOFlexCmd>(Cmd));
    });
}

void flex2pos_ReadSts(flex2pos* flex, int Sts[4]) {
    if (Sts == nullptr) return;
    std::fill_n(Sts, 4, 0);
    with(flex, [&](io::Flex2Pos& library) {
        const auto statuses = library.statuses();
        for (std::size_t i = 0; i < statuses.size(); ++i) Sts[i] = statuses[i] == io::sCal ? sCal : sNotCal;
    });
}

int flex2pos_image_make(const char* project, uint8_t ident, const uint8_t* payload, size_t payload_size, uint8_t* image,
                        size_t* size) {
    return guarded(
        {{size, "The pointer to the image's size is null. Nothing was created."}}, [&]() -> motionrack::Result<void> {
            io::ImageContent content;
            content.ident = ident;
            if (project != nullptr) content.project = project;
            if (payload != nullptr) content.payload.assign(payload, payload + payload_size);
            MOTIONRACK_TRY(const auto raw, io::raw_image(content));
            const std::vector<std::uint8_t> made = io::compressed(raw);
            const size_t capacity = image != nullptr ? *size : 0;
            *size = made.size();
            if (capacity < made.size())
                return motionrack::fail(motionrack::ErrorKind::invalid_input,
                                        fmt::format("The image has {} bytes, but the buffer only {}. The image was "
                                                    "not written. Call again with the returned size.",
                                                    made.size(), capacity));
            std::copy(made.begin(), made.end(), image);
            return {};
        });
}

int flex2pos_image_check(const uint8_t* image, size_t size) {
    int outcome = Flex_ErrCfg;
    const int code =
        guarded({{image, "The image is a null pointer. Nothing was done."}}, [&]() -> motionrack::Result<void> {
            MOTIONRACK_TRY(const auto raw, io::unpacked({image, size}));
            MOTIONRACK_TRY(const auto info, io::inspect(raw));
            outcome = Flex_ErrProject;
            MOTIONRACK_CHECK(io::check_project(info));
            outcome = Flex_Ok;
            return {};
        });
    return code == MR_OK ? static_cast<int>(Flex_Ok) : outcome;
}

}  // extern "C"
