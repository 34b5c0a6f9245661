// HDF5 library, loaded for the first recording: its dependencies are a third of all libraries that the program would
// load at start. The sources of this folder use the names of the loaded library.
#pragma once

#include <hdf5.h>

#include <motionrack/base/late_library.hpp>
#include <motionrack/base/result.hpp>

// clang-format off
#define MOTIONRACK_HDF5_FUNCTIONS(X) \
    X(H5open) X(H5check_version) X(H5Aclose) X(H5Acreate_by_name) X(H5Aexists) X(H5Aexists_by_name) X(H5Aget_space) \
    X(H5Aget_type) X(H5Aopen) X(H5Aopen_by_name) X(H5Aread) X(H5Awrite) X(H5Dclose) X(H5Dcreate2) \
    X(H5Dget_space) X(H5Dget_storage_size) X(H5Dget_type) X(H5Dopen2) X(H5Dread) X(H5Dset_extent) \
    X(H5Dwrite) X(H5Eset_auto2) X(H5Ewalk2) X(H5Fclose) X(H5Fcreate) X(H5Fflush) X(H5Fopen) \
    X(H5Fstart_swmr_write) X(H5Gclose) X(H5Gcreate2) X(H5Lexists) X(H5Pclose) X(H5Pcreate) \
    X(H5Pset_chunk) X(H5Pset_chunk_cache) X(H5Pset_create_intermediate_group) X(H5Pset_deflate) \
    X(H5Pset_fclose_degree) X(H5Pset_fletcher32) X(H5Pset_libver_bounds) \
    X(H5Pset_metadata_read_attempts) X(H5Pset_obj_track_times) X(H5Pset_shuffle) X(H5Sclose) \
    X(H5Screate) X(H5Screate_simple) X(H5Sget_simple_extent_dims) X(H5Sget_simple_extent_ndims) \
    X(H5Sget_simple_extent_npoints) X(H5Sselect_hyperslab) X(H5Tclose) X(H5Tcopy) X(H5Tget_class) \
    X(H5Tget_size) X(H5Tis_variable_str) X(H5Tset_size) X(H5Tset_strpad) X(H5dont_atexit)
#define MOTIONRACK_HDF5_NUMBERS(X) \
    X(H5T_NATIVE_INT8_g) X(H5T_NATIVE_INT32_g) X(H5T_NATIVE_INT64_g) X(H5T_NATIVE_FLOAT_g) \
    X(H5T_NATIVE_DOUBLE_g) X(H5T_C_S1_g) X(H5P_CLS_FILE_CREATE_ID_g) X(H5P_CLS_FILE_ACCESS_ID_g) \
    X(H5P_CLS_DATASET_CREATE_ID_g) X(H5P_CLS_DATASET_ACCESS_ID_g) X(H5P_CLS_LINK_CREATE_ID_g)
// clang-format on

namespace motionrack::trace::hdf5 {

/// Functions and constants of the library that are used here.
struct Hdf5Library {
#define MOTIONRACK_HDF5_MEMBER(name) decltype(&::name) name##_ = nullptr;
    MOTIONRACK_HDF5_FUNCTIONS(MOTIONRACK_HDF5_MEMBER)
    MOTIONRACK_HDF5_NUMBERS(MOTIONRACK_HDF5_MEMBER)
#undef MOTIONRACK_HDF5_MEMBER
    void find_in(LateLibrary& file) {
#define MOTIONRACK_HDF5_FIND(name) file.find(#name, name##_);
        MOTIONRACK_HDF5_FUNCTIONS(MOTIONRACK_HDF5_FIND)
        MOTIONRACK_HDF5_NUMBERS(MOTIONRACK_HDF5_FIND)
#undef MOTIONRACK_HDF5_FIND
    }
};

/// Loads the library. Errors: io if it is not installed. Once loaded, it stays loaded.
Result<void> load_library();
/// Returns the loaded library. Requires load_library().
const Hdf5Library& library();

}  // namespace motionrack::trace::hdf5

#define H5open (library().H5open_)
#define H5check_version (library().H5check_version_)
#define H5Aclose (library().H5Aclose_)
#define H5Acreate_by_name (library().H5Acreate_by_name_)
#define H5Aexists (library().H5Aexists_)
#define H5Aexists_by_name (library().H5Aexists_by_name_)
#define H5Aget_space (library().H5Aget_space_)
#define H5Aget_type (library().H5Aget_type_)
#define H5Aopen (library().H5Aopen_)
#define H5Aopen_by_name (library().H5Aopen_by_name_)
#define H5Aread (library().H5Aread_)
#define H5Awrite (library().H5Awrite_)
#define H5Dclose (library().H5Dclose_)
#define H5Dcreate2 (library().H5Dcreate2_)
#define H5Dget_space (library().H5Dget_space_)
#define H5Dget_storage_size (library().H5Dget_storage_size_)
#define H5Dget_type (library().H5Dget_type_)
#define H5Dopen2 (library().H5Dopen2_)
#define H5Dread (library().H5Dread_)
#define H5Dset_extent (library().H5Dset_extent_)
#define H5Dwrite (library().H5Dwrite_)
#define H5Eset_auto2 (library().H5Eset_auto2_)
#define H5Ewalk2 (library().H5Ewalk2_)
#define H5Fclose (library().H5Fclose_)
#define H5Fcreate (library().H5Fcreate_)
#define H5Fflush (library().H5Fflush_)
#define H5Fopen (library().H5Fopen_)
#define H5Fstart_swmr_write (library().H5Fstart_swmr_write_)
#define H5Gclose (library().H5Gclose_)
#define H5Gcreate2 (library().H5Gcreate2_)
#define H5Lexists (library().H5Lexists_)
#define H5Pclose (library().H5Pclose_)
#define H5Pcreate (library().H5Pcreate_)
#define H5Pset_chunk (library().H5Pset_chunk_)
#define H5Pset_chunk_cache (library().H5Pset_chunk_cache_)
#define H5Pset_create_intermediate_group (library().H5Pset_create_intermediate_group_)
#define H5Pset_deflate (library().H5Pset_deflate_)
#define H5Pset_fclose_degree (library().H5Pset_fclose_degree_)
#define H5Pset_fletcher32 (library().H5Pset_fletcher32_)
#define H5Pset_libver_bounds (library().H5Pset_libver_bounds_)
#define H5Pset_metadata_read_attempts (library().H5Pset_metadata_read_attempts_)
#define H5Pset_obj_track_times (library().H5Pset_obj_track_times_)
#define H5Pset_shuffle (library().H5Pset_shuffle_)
#define H5Sclose (library().H5Sclose_)
#define H5Screate (library().H5Screate_)
#define H5Screate_simple (library().H5Screate_simple_)
#define H5Sget_simple_extent_dims (library().H5Sget_simple_extent_dims_)
#define H5Sget_simple_extent_ndims (library().H5Sget_simple_extent_ndims_)
#define H5Sget_simple_extent_npoints (library().H5Sget_simple_extent_npoints_)
#define H5Sselect_hyperslab (library().H5Sselect_hyperslab_)
#define H5Tclose (library().H5Tclose_)
#define H5Tcopy (library().H5Tcopy_)
#define H5Tget_class (library().H5Tget_class_)
#define H5Tget_size (library().H5Tget_size_)
#define H5Tis_variable_str (library().H5Tis_variable_str_)
#define H5Tset_size (library().H5Tset_size_)
#define H5Tset_strpad (library().H5Tset_strpad_)
#define H5dont_atexit (library().H5dont_atexit_)
#define H5T_NATIVE_INT8_g (*library().H5T_NATIVE_INT8_g_)
#define H5T_NATIVE_INT32_g (*library().H5T_NATIVE_INT32_g_)
#define H5T_NATIVE_INT64_g (*library().H5T_NATIVE_INT64_g_)
#define H5T_NATIVE_FLOAT_g (*library().H5T_NATIVE_FLOAT_g_)
#define H5T_NATIVE_DOUBLE_g (*library().H5T_NATIVE_DOUBLE_g_)
#define H5T_C_S1_g (*library().H5T_C_S1_g_)
#define H5P_CLS_FILE_CREATE_ID_g (*library().H5P_CLS_FILE_CREATE_ID_g_)
#define H5P_CLS_FILE_ACCESS_ID_g (*library().H5P_CLS_FILE_ACCESS_ID_g_)
#define H5P_CLS_DATASET_CREATE_ID_g (*library().H5P_CLS_DATASET_CREATE_ID_g_)
#define H5P_CLS_DATASET_ACCESS_ID_g (*library().H5P_CLS_DATASET_ACCESS_ID_g_)
#define H5P_CLS_LINK_CREATE_ID_g (*library().H5P_CLS_LINK_CREATE_ID_g_)
