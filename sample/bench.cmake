# The benchmark; included by the CMakeLists.txt of this folder.
nrd_shader_library(bench_shaders NAMESPACE bench_shaders INCLUDES
    "${CMAKE_CURRENT_SOURCE_DIR}/shaders" "${PROJECT_SOURCE_DIR}/shaders/include" "${PROJECT_SOURCE_DIR}/shaders/lib")
nrd_add_shader(BenchTrace shaders/bench_trace.comp.glsl)
nrd_add_shader(BenchCopy shaders/bench_copy.comp.glsl)
nrd_end_shader_library()

# The program, but for main(), as a library for its tests.
add_library(nrd_bench STATIC
    bench_bandwidth.cpp
    bench_camera.cpp
    bench_emission.cpp
    bench_inputs.cpp
    bench_options.cpp
    bench_report.cpp
    bench_run.cpp
    bench_slots.cpp
    bench_traffic.cpp)
target_link_libraries(nrd_bench PUBLIC nrd_replay nrd_program nrd_engine nrd::integration
    PRIVATE bench_shaders nlohmann_json::nlohmann_json CLI11::CLI11 nrd_warnings)

add_executable(nrd-bench bench_main.cpp)
target_link_libraries(nrd-bench PRIVATE nrd_bench nrd_warnings)
