# Captures, error measures and the replay tool; included by the CMakeLists.txt of this folder.
find_package(OpenEXR 3.1 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(Threads REQUIRED)

# No denoiser, no graphics API: files and arithmetic.
add_library(nrd_capture STATIC capture.cpp capture_json.cpp exr.cpp image_io.cpp)
target_include_directories(nrd_capture PUBLIC "${CMAKE_CURRENT_SOURCE_DIR}")
target_link_libraries(nrd_capture PRIVATE OpenEXR::OpenEXR nlohmann_json::nlohmann_json Threads::Threads nrd_warnings)

add_library(nrd_measures STATIC
    measures/filter.cpp
    measures/flip.cpp
    measures/frame_measures.cpp
    measures/measures.cpp
    measures/sequence.cpp
    measures/signals.cpp)
target_include_directories(nrd_measures PUBLIC "${CMAKE_CURRENT_SOURCE_DIR}/measures")
target_link_libraries(nrd_measures PUBLIC nrd_capture PRIVATE Threads::Threads nrd_warnings)

# What programs share round their work.
add_library(nrd_program STATIC program.cpp resolution.cpp)
target_compile_definitions(nrd_program PRIVATE NRD_TEST_DATA="${NRD_TEST_DATA}")
target_link_libraries(nrd_program PUBLIC nrd_capture nrd::nrd PRIVATE nrd_fields nrd_measures CLI11::CLI11 nrd_warnings)

# The denoisers by name and --set, of all programs.
add_library(nrd_settings STATIC name_choice.cpp replay_denoisers.cpp replay_settings.cpp)
target_link_libraries(nrd_settings PUBLIC nrd_measures nrd_fields nrd::nrd PRIVATE nrd_warnings)

# What the replay tool is made of but for Vulkan, for its tests too.
add_library(nrd_replay STATIC
    replay_camera.cpp
    replay_output.cpp
    replay_report.cpp
    replay_tables.cpp)
target_link_libraries(nrd_replay PUBLIC nrd_settings PRIVATE nlohmann_json::nlohmann_json nrd_warnings)

nrd_shader_library(replay_shaders NAMESPACE replay INCLUDES
    "${CMAKE_CURRENT_SOURCE_DIR}/shaders" "${PROJECT_SOURCE_DIR}/shaders/include")
nrd_add_shader(ReplayPack shaders/replay_pack.comp.glsl)
nrd_add_shader(ReplayUnpack shaders/replay_unpack.comp.glsl)
nrd_end_shader_library()

# And what needs Vulkan.
add_library(nrd_replay_gpu STATIC replay_doctor.cpp replay_gpu.cpp replay_packing.cpp replay_run.cpp
    replay_slots.cpp)
target_link_libraries(nrd_replay_gpu PUBLIC nrd_replay nrd_engine nrd::integration PRIVATE replay_shaders nrd_warnings)

add_executable(nrd-replay replay_main.cpp)
target_link_libraries(nrd-replay PRIVATE nrd_replay_gpu nrd_program CLI11::CLI11 nrd_warnings)
