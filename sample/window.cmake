# The sample as a window; included by the CMakeLists.txt of this folder.

nrd_shader_library(nrd_window_shaders NAMESPACE window INCLUDES ${CMAKE_CURRENT_SOURCE_DIR}/shaders)
nrd_add_shader(Display shaders/display.comp.glsl)
nrd_end_shader_library()

# All of it but the window itself, for tests and builds without one.
add_library(nrd_viewer STATIC
    window/camera_control.cpp
    window/display.cpp
    window/live_reference.cpp
    window/loader.cpp
    window/pick.cpp
    window/recorder.cpp
    window/script.cpp
    window/sun.cpp
    window/viewer.cpp
    window/viewer_state.cpp
    window/views.cpp)
target_link_libraries(nrd_viewer PUBLIC nrd_sample PRIVATE nrd_window_shaders Threads::Threads nrd_warnings)

if(NRD_BUILD_WINDOW)
    find_package(glfw3 3.3 REQUIRED)
    find_path(NRD_IMGUI_INCLUDE_DIR backends/imgui_impl_vulkan.h PATH_SUFFIXES imgui REQUIRED)
    find_library(NRD_IMGUI_LIBRARY imgui REQUIRED)
    find_library(NRD_STB_LIBRARY stb) # which some builds of Dear ImGui take their fonts from
    if(NRD_STB_LIBRARY)
        set(imgui_needs "${NRD_STB_LIBRARY}")
    endif()
    add_library(nrd_window STATIC
        window/app.cpp
        window/app_script.cpp
        window/gui.cpp
        window/panel.cpp
        window/panel_denoiser.cpp
        window/panel_figures.cpp
        window/panel_scene.cpp
        window/panel_settings.cpp
        window/screen.cpp
        window/swapchain.cpp
        window/window.cpp)
    target_include_directories(nrd_window SYSTEM PRIVATE "${NRD_IMGUI_INCLUDE_DIR}")
    target_link_libraries(nrd_window PUBLIC nrd_viewer PRIVATE "${NRD_IMGUI_LIBRARY}" ${imgui_needs} glfw nrd_warnings)
    target_compile_definitions(nrd_window INTERFACE NRD_HAS_WINDOW)
    if(NRD_HOT_RELOAD)
        target_sources(nrd_window PRIVATE window/shader_reload.cpp)
        target_link_libraries(nrd_window PRIVATE nrd_shader_compiler)
        target_compile_definitions(nrd_window PRIVATE NRD_HOT_RELOAD
            NRD_SHADER_SOURCES="${PROJECT_SOURCE_DIR}/shaders"
            NRD_SHADER_MANIFEST="$<TARGET_PROPERTY:nrd_shaders,NRD_MANIFEST>")
    endif()
endif()
