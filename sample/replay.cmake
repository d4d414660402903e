# Captures, error measures and the replay tool; included by the CMakeLists.txt of this folder.
find_package(OpenEXR 3.1 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Threads REQUIRED)

add_library(nrd_capture STATIC ${CMAKE_CURRENT_LIST_DIR}/capture.cpp ${CMAKE_CURRENT_LIST_DIR}/capture_json.cpp
    ${CMAKE_CURRENT_LIST_DIR}/exr.cpp ${CMAKE_CURRENT_LIST_DIR}/image_io.cpp)
target_include_directories(nrd_capture PUBLIC "${CMAKE_CURRENT_LIST_DIR}")
target_link_libraries(nrd_capture PRIVATE OpenEXR::OpenEXR nlohmann_json::nlohmann_json Threads::Threads nrd_warnings)

add_library(nrd_measures STATIC
    ${CMAKE_CURRENT_LIST_DIR}/measures/filter.cpp
    ${CMAKE_CURRENT_LIST_DIR}/measures/flip.cpp
    ${CMAKE_CURRENT_LIST_DIR}/measures/frame_measures.cpp
    ${CMAKE_CURRENT_LIST_DIR}/measures/measures.cpp
    ${CMAKE_CURRENT_LIST_DIR}/measures/sequence.cpp
    ${CMAKE_CURRENT_LIST_DIR}/measures/signals.cpp)
target_include_directories(nrd_measures PUBLIC "${CMAKE_CURRENT_LIST_DIR}/measures")
target_link_libraries(nrd_measures PUBLIC nrd_capture PRIVATE nrd_warnings)
