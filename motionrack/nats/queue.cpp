// JetStream over the C client.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/nats/nats_library.hpp>
#include <motionrack/nats/queue.hpp>
#include <utility>

namespace motionrack::nats {

namespace {

constexpr const char *points_stream = "MOTIONRACK_POINTS", *rows_stream = "MOTIONRACK_ROWS";
constexpr std::int64_t nanoseconds_a_ms = 1'000'000, nanoseconds_a_day = 86'400'000'000'000;

/// Destroys a library handle.
struct Destroy {
    void operator()(natsOptions* one) const { natsOptions_Destroy(one); }
    void operator()(natsConnection* one) const { natsConnection_Destroy(one); }
    void operator()(jsCtx* one) const { jsCtx_Destroy(one); }
    void operator()(natsSubscription* one) const { natsSubscription_Destroy(one); }
    void operator()(natsMsg* one) const { natsMsg_Destroy(one); }
};

using Options = std::unique_ptr<natsOptions, Destroy>;
using Connection = std::unique_ptr<natsConnection, Destroy>;
using Context = std::unique_ptr<jsCtx, Destroy>;
using Subscription = std::unique_ptr<natsSubscription, Destroy>;
using Message = std::unique_ptr<natsMsg, Destroy>;

tl::unexpected<Error> trouble(natsStatus status, const char* what) {
    const char* last = nats_GetLastError(nullptr);
    const std::string why = last != nullptr && *last != '\0' ? last : natsStatus_GetText(status);
    return fail(ErrorKind::io,
                fmt::format("{}: {}. Check that nats-server runs there with JetStream (nats-server -js).", what, why));
}

/// Subject tokens must not contain dots.
std::string version_word() {
    std::string out = MOTIONRACK_VERSION;
    std::replace(out.begin(), out.end(), '.', '_');
    return out;
}

std::string points_subject(const std::string& sweep, const std::string& key) {
    return fmt::format("motionrack.points.{}.{}.{}", version_word(), sweep, key);
}
std::string rows_subject(const std::string& sweep, const std::string& key) {
    return fmt::format("motionrack.rows.{}.{}.{}", version_word(), sweep, key);
}

/// Returns token `n` of a message's subject, from 0.
std::string subject_word(natsMsg* message, int n) {
    std::string_view rest = natsMsg_GetSubject(message);
    for (; n > 0; --n) rest.remove_prefix(std::min(rest.find('.'), rest.size() - 1) + 1);
    return std::string(rest.substr(0, rest.find('.')));
}

std::string_view bytes_of(natsMsg* message) {
    return {natsMsg_GetData(message), static_cast<std::size_t>(natsMsg_GetDataLength(message))};
}

/// Returns true if no message arrived: none is available, or the server is reconnecting.
bool is_quiet(natsStatus status) {
    return status == NATS_TIMEOUT || status == NATS_NO_RESPONDERS || status == NATS_NO_SERVER ||
           status == NATS_CONNECTION_DISCONNECTED || status == NATS_NOT_FOUND;
}

class TakenPoint final : public LeasedPoint {
  public:
    explicit TakenPoint(Message message) : message_(std::move(message)) {
        jsMsgMetaData* meta = nullptr;
        if (natsMsg_GetMetaData(&meta, message_.get()) == NATS_OK) times_ = meta->NumDelivered;
        jsMsgMetaData_Destroy(meta);
    }
    std::string_view text() const override { return bytes_of(message_.get()); }
    std::string sweep() const override { return subject_word(message_.get(), 3); }
    std::uint64_t times() const override { return times_; }
    void renew() override { natsMsg_InProgress(message_.get(), nullptr); }
    Result<void> done() override {
        const natsStatus status = natsMsg_AckSync(message_.get(), nullptr, nullptr);
        return status == NATS_OK ? Result<void>()
                                 : Result<void>(trouble(status, "A finished point was not reported to the server"));
    }
    void give_back() override { natsMsg_Nak(message_.get(), nullptr); }

  private:
    Message message_;
    std::uint64_t times_ = 1;
};

class JetStreamQueue final : public Queue {
  public:
    Result<void> connect(const std::string& url) {
        natsOptions* options = nullptr;
        natsStatus status = natsOptions_Create(&options);
        const Options owned(options);
        if (status == NATS_OK) status = natsOptions_SetURL(options, url.c_str());
        if (status == NATS_OK) status = natsOptions_SetName(options, "motionrack");
        if (status == NATS_OK) status = natsOptions_SetTimeout(options, 10'000);
        if (status == NATS_OK) status = natsOptions_SetMaxReconnect(options, -1);
        if (status == NATS_OK) status = natsOptions_SetReconnectWait(options, 500);
        if (status == NATS_OK)
            status = natsOptions_SetErrorHandler(
                options, [](natsConnection*, natsSubscription*, natsStatus, void*) {}, nullptr);
        natsConnection* connection = nullptr;
        if (status == NATS_OK) status = natsConnection_Connect(&connection, options);
        connection_.reset(connection);
        if (status != NATS_OK)
            return trouble(status, fmt::format("Not connected to {}", without_password(url)).c_str());
        jsCtx* js = nullptr;
        status = natsConnection_JetStream(&js, connection, nullptr);
        js_.reset(js);
        if (status != NATS_OK) return trouble(status, "JetStream cannot be used");
        return make_streams();
    }

    Result<void> offer(const std::string& sweep, const std::string& key, std::string_view text) override {
        if (const auto max_payload = natsConnection_GetMaxPayload(connection_.get());
            static_cast<std::int64_t>(text.size()) > max_payload)
            return fail(ErrorKind::refused,
                        fmt::format("A point of the sweep has {} bytes, and the server takes messages of at most {}. "
                                    "Nothing was queued; set max_payload of nats-server "
                                    "higher, or shorten the program.",
                                    text.size(), max_payload));
        return put(points_subject(sweep, key), text, "A point cannot be queued");
    }

    Result<std::vector<PointResult>> answers(const std::string& sweep, std::int64_t wait_ms) override {
        std::vector<PointResult> out;
        if (!answers_) {
            const std::string subject = rows_subject(sweep, "*");
            jsSubOptions options;
            jsSubOptions_Init(&options);
            options.Stream = rows_stream;
            options.Config.AckPolicy = js_AckExplicit;
            options.Config.AckWait = 60'000 * nanoseconds_a_ms;
            options.Config.MaxAckPending = -1;
            options.Config.InactiveThreshold = 60'000 * nanoseconds_a_ms;
            natsSubscription* made = nullptr;
            const natsStatus status =
                js_PullSubscribe(&made, js_.get(), subject.c_str(), nullptr, nullptr, &options, nullptr);
            if (is_quiet(status)) return out;
            if (status != NATS_OK) return trouble(status, "Rows cannot be fetched");
            answers_.reset(made);
        }
        natsMsgList list{};
        const natsStatus status = natsSubscription_Fetch(&list, answers_.get(), 256, wait_ms, nullptr);
        for (int i = 0; i < list.Count; ++i) {
            out.push_back({subject_word(list.Msgs[i], 4), std::string(bytes_of(list.Msgs[i]))});
            natsMsg_Ack(list.Msgs[i], nullptr);
        }
        natsMsgList_Destroy(&list);
        if (status != NATS_OK && !is_quiet(status)) return trouble(status, "Rows cannot be fetched");
        return out;
    }

    Result<void> forget(const std::string& sweep, const std::string& key) override {
        for (const auto& [stream, subject] :
             {std::pair{points_stream, points_subject(sweep, key)}, std::pair{rows_stream, rows_subject(sweep, key)}}) {
            jsOptions options;
            jsOptions_Init(&options);
            options.Stream.Purge.Subject = subject.c_str();
            if (const natsStatus status = js_PurgeStream(js_.get(), stream, &options, nullptr); status != NATS_OK)
                return trouble(status, "Rows cannot be removed from the server");
        }
        return {};
    }

    bool came_back() override {
        natsStatistics* statistics = nullptr;
        std::uint64_t reconnects = 0;
        if (natsStatistics_Create(&statistics) == NATS_OK &&
            natsConnection_GetStats(connection_.get(), statistics) == NATS_OK)
            natsStatistics_GetCounts(statistics, nullptr, nullptr, nullptr, nullptr, &reconnects);
        natsStatistics_Destroy(statistics);
        if (reconnects == reconnects_ || natsConnection_Status(connection_.get()) != NATS_CONN_STATUS_CONNECTED ||
            !make_streams())
            return false;
        reconnects_ = reconnects;
        answers_.reset();
        points_.reset();
        return true;
    }

    Result<std::unique_ptr<LeasedPoint>> take(std::int64_t wait_ms) override {
        (void)came_back();
        if (!points_) MOTIONRACK_CHECK(join_workers());
        natsMsgList list{};
        const natsStatus status = natsSubscription_Fetch(&list, points_.get(), 1, wait_ms, nullptr);
        if (status == NATS_OK && list.Count == 1) {
            Message message(std::exchange(list.Msgs[0], nullptr));
            natsMsgList_Destroy(&list);
            return std::make_unique<TakenPoint>(std::move(message));
        }
        natsMsgList_Destroy(&list);
        if (status != NATS_OK && !is_quiet(status)) return trouble(status, "Points cannot be fetched");
        return std::unique_ptr<LeasedPoint>();
    }

    Result<void> answer(const std::string& sweep, const std::string& key, std::string_view text) override {
        return put(rows_subject(sweep, key), text, "A row cannot be sent");
    }

  private:
    /// Creates both streams and the shared consumer of the workers. Existing ones stay unchanged.
    Result<void> make_streams() {
        const std::string points = "motionrack.points.>", rows = "motionrack.rows.>";
        MOTIONRACK_CHECK(make_stream(points_stream, points.c_str(), js_WorkQueuePolicy));
        MOTIONRACK_CHECK(make_stream(rows_stream, rows.c_str(), js_LimitsPolicy));
        const std::string name = "workers_" + version_word(),
                          subject = fmt::format("motionrack.points.{}.>", version_word());
        jsConsumerConfig consumer;
        jsConsumerConfig_Init(&consumer);
        consumer.Durable = name.c_str();
        consumer.FilterSubject = subject.c_str();
        consumer.AckPolicy = js_AckExplicit;
        consumer.AckWait = silence_ms * nanoseconds_a_ms;
        consumer.MaxAckPending = -1;
        const natsStatus status = js_AddConsumer(nullptr, js_.get(), points_stream, &consumer, nullptr, nullptr);
        return status == NATS_OK ? Result<void>()
                                 : Result<void>(trouble(status, "The workers' queue could not be created"));
    }

    Result<void> make_stream(const char* name, const char* subject, jsRetentionPolicy retention) {
        jsStreamConfig stream;
        jsStreamConfig_Init(&stream);
        stream.Name = name;
        stream.Subjects = &subject;
        stream.SubjectsLen = 1;
        stream.Retention = retention;
        stream.MaxAge = kept_days * nanoseconds_a_day;
        stream.MaxMsgsPerSubject = 1;
        stream.Discard = js_DiscardNew;
        stream.DiscardNewPerSubject = true;
        const natsStatus status = js_AddStream(nullptr, js_.get(), &stream, nullptr, nullptr);
        return status == NATS_OK
                   ? Result<void>()
                   : Result<void>(trouble(status, fmt::format("The stream {} could not be created", name).c_str()));
    }

    Result<void> join_workers() {
        const std::string name = "workers_" + version_word(),
                          subject = fmt::format("motionrack.points.{}.>", version_word());
        jsSubOptions options;
        jsSubOptions_Init(&options);
        options.Stream = points_stream;
        options.Consumer = name.c_str();
        natsSubscription* made = nullptr;
        const natsStatus status =
            js_PullSubscribe(&made, js_.get(), subject.c_str(), name.c_str(), nullptr, &options, nullptr);
        if (status != NATS_OK) return trouble(status, "Points cannot be fetched");
        points_.reset(made);
        return {};
    }

    /// Publishes one message per subject. A rejected duplicate counts as success.
    Result<void> put(const std::string& subject, std::string_view text, const char* what) {
        jsErrCode code{};
        const natsStatus status =
            js_Publish(nullptr, js_.get(), subject.c_str(), text.data(), static_cast<int>(text.size()), nullptr, &code);
        const char* last = status == NATS_OK ? nullptr : nats_GetLastError(nullptr);
        const bool there = code == JSStreamStoreFailedErr && last != nullptr &&
                           std::string_view(last).find("per subject") != std::string_view::npos;
        if (status == NATS_OK || there) return {};
        return trouble(status, what);
    }

    Connection connection_;
    Context js_;
    Subscription answers_, points_;
    std::uint64_t reconnects_ = 0;
};

}  // namespace

std::string without_password(const std::string& url) {
    const std::size_t at = url.rfind('@'), slashes = url.find("//");
    return at == std::string::npos || slashes == std::string::npos || slashes > at
               ? url
               : url.substr(0, slashes + 2) + url.substr(at + 1);
}

Result<std::unique_ptr<Queue>> Queue::open(const std::string& url) {
    MOTIONRACK_CHECK(load_library());
    auto out = std::make_unique<JetStreamQueue>();
    MOTIONRACK_CHECK(out->connect(url));
    return out;
}

}  // namespace motionrack::nats
