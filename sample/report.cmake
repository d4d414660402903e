# The speed-against-error report; included by the CMakeLists.txt of this folder.

# The program, but for main(), as a library for its tests.
add_library(nrd_report STATIC
    report_front.cpp
    report_options.cpp
    report_plot.cpp
    report_points.cpp
    report_row.cpp
    report_run.cpp
    report_table.cpp
    report_times.cpp)
target_link_libraries(nrd_report PUBLIC nrd_bench nrd_replay_gpu nrd_program
    PRIVATE nlohmann_json::nlohmann_json CLI11::CLI11 nrd_warnings)

add_executable(nrd-report report_main.cpp)
target_link_libraries(nrd-report PRIVATE nrd_report nrd_warnings)
