// Cyclone DDS, loaded when a process first uses a bus on a network. The sources of this module call its functions by
// their own names, which stand for those of the loaded library.
#pragma once

#include <dds/dds.h>

#include <motionrack/base/late_library.hpp>
#include <motionrack/base/result.hpp>

// clang-format off
#define MOTIONRACK_DDS_FUNCTIONS(X) \
    X(dds_create_listener) X(dds_create_participant) X(dds_create_qos) X(dds_create_reader) X(dds_create_topic) \
    X(dds_create_writer) X(dds_delete) X(dds_delete_listener) X(dds_delete_qos) X(dds_lset_data_available) \
    X(dds_qset_durability) X(dds_qset_history) X(dds_qset_ignorelocal) X(dds_qset_partition1) \
    X(dds_qset_reliability) X(dds_strretcode) X(dds_take) X(dds_write)
// clang-format on

namespace motionrack::dds {

/// The library functions that this module uses.
struct DdsLibrary {
#define MOTIONRACK_DDS_MEMBER(name) decltype(&::name) name##_ = nullptr;
    MOTIONRACK_DDS_FUNCTIONS(MOTIONRACK_DDS_MEMBER)
#undef MOTIONRACK_DDS_MEMBER
    void find_in(LateLibrary& file) {
#define MOTIONRACK_DDS_FIND(name) file.find(#name, name##_);
        MOTIONRACK_DDS_FUNCTIONS(MOTIONRACK_DDS_FIND)
#undef MOTIONRACK_DDS_FIND
    }
};

/// Loads the library. Errors: io, it is not installed. A loaded library stays loaded.
Result<void> load_library();
/// Returns the loaded library. Requires load_library().
const DdsLibrary& library();

}  // namespace motionrack::dds

#define dds_create_listener (motionrack::dds::library().dds_create_listener_)
#define dds_create_participant (motionrack::dds::library().dds_create_participant_)
#define dds_create_qos (motionrack::dds::library().dds_create_qos_)
#define dds_create_reader (motionrack::dds::library().dds_create_reader_)
#define dds_create_topic (motionrack::dds::library().dds_create_topic_)
#define dds_create_writer (motionrack::dds::library().dds_create_writer_)
#define dds_delete (motionrack::dds::library().dds_delete_)
#define dds_delete_listener (motionrack::dds::library().dds_delete_listener_)
#define dds_delete_qos (motionrack::dds::library().dds_delete_qos_)
#define dds_lset_data_available (motionrack::dds::library().dds_lset_data_available_)
#define dds_qset_durability (motionrack::dds::library().dds_qset_durability_)
#define dds_qset_history (motionrack::dds::library().dds_qset_history_)
#define dds_qset_ignorelocal (motionrack::dds::library().dds_qset_ignorelocal_)
#define dds_qset_partition1 (motionrack::dds::library().dds_qset_partition1_)
#define dds_qset_reliability (motionrack::dds::library().dds_qset_reliability_)
#define dds_strretcode (motionrack::dds::library().dds_strretcode_)
#define dds_take (motionrack::dds::library().dds_take_)
#define dds_write (motionrack::dds::library().dds_write_)
