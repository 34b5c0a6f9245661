// NATS client library, loaded for the first sweep over several machines. The sources of this folder use the names of
// the loaded library.
#pragma once

#include <nats/nats.h>

#include <motionrack/base/late_library.hpp>
#include <motionrack/base/result.hpp>

// clang-format off
#define MOTIONRACK_NATS_FUNCTIONS(X) \
    X(jsConsumerConfig_Init) X(jsCtx_Destroy) X(jsMsgMetaData_Destroy) X(jsOptions_Init) X(jsStreamConfig_Init) \
    X(jsSubOptions_Init) X(js_AddConsumer) X(js_AddStream) X(js_Publish) X(js_PullSubscribe) X(js_PurgeStream) \
    X(natsConnection_Connect) X(natsConnection_Destroy) X(natsConnection_GetMaxPayload) X(natsConnection_GetStats) \
    X(natsConnection_JetStream) X(natsConnection_Status) X(natsMsgList_Destroy) X(natsMsg_Ack) X(natsMsg_AckSync) \
    X(natsMsg_Destroy) X(natsMsg_GetData) X(natsMsg_GetDataLength) X(natsMsg_GetMetaData) X(natsMsg_GetSubject) \
    X(natsMsg_InProgress) X(natsMsg_Nak) X(natsOptions_Create) X(natsOptions_Destroy) X(natsOptions_SetErrorHandler) \
    X(natsOptions_SetMaxReconnect) X(natsOptions_SetName) X(natsOptions_SetReconnectWait) X(natsOptions_SetTimeout) \
    X(natsOptions_SetURL) X(natsStatistics_Create) X(natsStatistics_Destroy) X(natsStatistics_GetCounts) \
    X(natsStatus_GetText) X(natsSubscription_Destroy) X(natsSubscription_Fetch) X(nats_GetLastError)
// clang-format on

namespace motionrack::nats {

/// Functions of the library that are used here.
struct NatsLibrary {
#define MOTIONRACK_NATS_MEMBER(name) decltype(&::name) name##_ = nullptr;
    MOTIONRACK_NATS_FUNCTIONS(MOTIONRACK_NATS_MEMBER)
#undef MOTIONRACK_NATS_MEMBER
    void find_in(LateLibrary& file) {
#define MOTIONRACK_NATS_FIND(name) file.find(#name, name##_);
        MOTIONRACK_NATS_FUNCTIONS(MOTIONRACK_NATS_FIND)
#undef MOTIONRACK_NATS_FIND
    }
};

/// Errors: io if the library is not installed. Once loaded, it stays loaded.
Result<void> load_library();
/// Requires load_library().
const NatsLibrary& library();

}  // namespace motionrack::nats

#define jsConsumerConfig_Init (library().jsConsumerConfig_Init_)
#define jsCtx_Destroy (library().jsCtx_Destroy_)
#define jsMsgMetaData_Destroy (library().jsMsgMetaData_Destroy_)
#define jsOptions_Init (library().jsOptions_Init_)
#define jsStreamConfig_Init (library().jsStreamConfig_Init_)
#define jsSubOptions_Init (library().jsSubOptions_Init_)
#define js_AddConsumer (library().js_AddConsumer_)
#define js_AddStream (library().js_AddStream_)
#define js_Publish (library().js_Publish_)
#define js_PullSubscribe (library().js_PullSubscribe_)
#define js_PurgeStream (library().js_PurgeStream_)
#define natsConnection_Connect (library().natsConnection_Connect_)
#define natsConnection_Destroy (library().natsConnection_Destroy_)
#define natsConnection_GetMaxPayload (library().natsConnection_GetMaxPayload_)
#define natsConnection_GetStats (library().natsConnection_GetStats_)
#define natsConnection_JetStream (library().natsConnection_JetStream_)
#define natsConnection_Status (library().natsConnection_Status_)
#define natsMsgList_Destroy (library().natsMsgList_Destroy_)
#define natsMsg_Ack (library().natsMsg_Ack_)
#define natsMsg_AckSync (library().natsMsg_AckSync_)
#define natsMsg_Destroy (library().natsMsg_Destroy_)
#define natsMsg_GetData (library().natsMsg_GetData_)
#define natsMsg_GetDataLength (library().natsMsg_GetDataLength_)
#define natsMsg_GetMetaData (library().natsMsg_GetMetaData_)
#define natsMsg_GetSubject (library().natsMsg_GetSubject_)
#define natsMsg_InProgress (library().natsMsg_InProgress_)
#define natsMsg_Nak (library().natsMsg_Nak_)
#define natsOptions_Create (library().natsOptions_Create_)
#define natsOptions_Destroy (library().natsOptions_Destroy_)
#define natsOptions_SetErrorHandler (library().natsOptions_SetErrorHandler_)
#define natsOptions_SetMaxReconnect (library().natsOptions_SetMaxReconnect_)
#define natsOptions_SetName (library().natsOptions_SetName_)
#define natsOptions_SetReconnectWait (library().natsOptions_SetReconnectWait_)
#define natsOptions_SetTimeout (library().natsOptions_SetTimeout_)
#define natsOptions_SetURL (library().natsOptions_SetURL_)
#define natsStatistics_Create (library().natsStatistics_Create_)
#define natsStatistics_Destroy (library().natsStatistics_Destroy_)
#define natsStatistics_GetCounts (library().natsStatistics_GetCounts_)
#define natsStatus_GetText (library().natsStatus_GetText_)
#define natsSubscription_Destroy (library().natsSubscription_Destroy_)
#define natsSubscription_Fetch (library().natsSubscription_Fetch_)
#define nats_GetLastError (library().nats_GetLastError_)
