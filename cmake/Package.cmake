# Installation and packages: libraries in both kinds, headers, shaders, SPIR-V, the files for find_package() and
# pkg-config, and what CPack needs. Two components, as of distributions: runtime and development; and the sources with
# their SPIR-V, which are asked for by name.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(soversion ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}) # until 1.0 a minor version may break the interface
set(data_dir "${CMAKE_INSTALL_DATADIR}/nrd")
set(config_dir "${CMAKE_INSTALL_LIBDIR}/cmake/nrd")

# nrd_add_shared(target FROM static libraries): a shared library of the same objects.
function(nrd_add_shared target)
    cmake_parse_arguments(ARG "" "OUTPUT" "FROM" ${ARGN})
    add_library(${target} SHARED)
    foreach(part IN LISTS ARG_FROM)
        target_sources(${target} PRIVATE $<TARGET_OBJECTS:${part}>)
    endforeach()
    target_compile_features(${target} PUBLIC cxx_std_17)
    target_link_options(${target} PRIVATE -Wl,--no-undefined -Wl,--as-needed)
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:nrd_warnings>)
    set_target_properties(${target} PROPERTIES OUTPUT_NAME ${ARG_OUTPUT} LINKER_LANGUAGE CXX
        VERSION ${PROJECT_VERSION} SOVERSION ${soversion} INSTALL_RPATH "$ORIGIN")
endfunction()

function(nrd_install export)
    install(TARGETS ${ARGN} EXPORT ${export}
        RUNTIME COMPONENT runtime
        LIBRARY COMPONENT runtime NAMELINK_COMPONENT development
        ARCHIVE COMPONENT development
        FILE_SET HEADERS COMPONENT development)
    install(EXPORT ${export} NAMESPACE nrd:: DESTINATION "${config_dir}" FILE ${export}.cmake COMPONENT development)
endfunction()

function(nrd_install_shaders target)
    get_target_property(manifest ${target} NRD_MANIFEST)
    get_target_property(modules ${target} NRD_MODULES)
    install(FILES "${manifest}" DESTINATION "${data_dir}/shaders" COMPONENT development)
    install(FILES ${modules} DESTINATION "${data_dir}/spirv/${target}" COMPONENT development)
    install(FILES ${modules} DESTINATION "spirv/${target}" COMPONENT source EXCLUDE_FROM_ALL)
endfunction()

function(nrd_install_pkgconfig name)
    configure_file("${PROJECT_SOURCE_DIR}/cmake/${name}.pc.in" "${PROJECT_BINARY_DIR}/${name}.pc" @ONLY)
    install(FILES "${PROJECT_BINARY_DIR}/${name}.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig"
        COMPONENT development)
endfunction()

# The descriptor library and the shaders that applications include.
nrd_add_shared(nrd_shared OUTPUT nrd FROM nrd nrd_shaders)
target_include_directories(nrd_shared INTERFACE "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
set_target_properties(nrd PROPERTIES EXPORT_NAME nrd_static)
set_target_properties(nrd_front_end PROPERTIES EXPORT_NAME shaders)
nrd_install(nrdCoreTargets nrd nrd_shared nrd_front_end)
nrd_install_shaders(nrd_shaders)
nrd_install_pkgconfig(nrd)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/shaders/" DESTINATION "${data_dir}/shaders" COMPONENT development
    FILES_MATCHING PATTERN "*.glsl" PATTERN "*.h")
set(installed_libraries nrd nrd_shared)

# NrdIntegration and the plug-in.
if(TARGET nrd_integration)
    find_package(Vulkan REQUIRED) # its headers
    nrd_add_shared(nrd_integration_shared OUTPUT nrd_integration
        FROM nrd_integration nrd_doctor nrd_integration_shaders)
    target_include_directories(nrd_integration_shared INTERFACE "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
    target_link_libraries(nrd_integration_shared PUBLIC nrd_shared Vulkan::Headers PRIVATE nrd_rhi)
    set_target_properties(nrd_integration PROPERTIES EXPORT_NAME integration_static)
    set_target_properties(nrd_integration_shared PROPERTIES EXPORT_NAME integration_shared)
    set_target_properties(nrd_doctor PROPERTIES EXPORT_NAME doctor_static)
    set_target_properties(nrd_rhi PROPERTIES EXPORT_NAME rhi_static)
    set_target_properties(nrd_plugin PROPERTIES EXPORT_NAME plugin)
    nrd_install(nrdIntegrationTargets nrd_integration nrd_integration_shared nrd_doctor nrd_rhi nrd_plugin)
    nrd_install_shaders(nrd_integration_shaders)
    nrd_install_pkgconfig(nrd-integration)
    nrd_install_pkgconfig(nrd-plugin)
    install(FILES "${PROJECT_SOURCE_DIR}/integration/plugin/NrdPlugin.cs" DESTINATION "${data_dir}"
        COMPONENT development)
    list(APPEND installed_libraries nrd_integration nrd_integration_shared nrd_doctor nrd_rhi nrd_plugin)
endif()
add_custom_target(nrd_package DEPENDS ${installed_libraries}) # what must be built before it is installed

# find_package(nrd CONFIG)
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/nrdConfig.cmake.in" "${PROJECT_BINARY_DIR}/nrdConfig.cmake"
    INSTALL_DESTINATION "${config_dir}" PATH_VARS data_dir)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/nrdConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/nrdConfig.cmake" "${PROJECT_BINARY_DIR}/nrdConfigVersion.cmake"
    DESTINATION "${config_dir}" COMPONENT development)
foreach(package runtime development) # one folder for each package of a distribution
    set(suffix $<$<STREQUAL:${package},development>:-dev>)
    install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/nrd${suffix}"
        RENAME copyright COMPONENT ${package})
endforeach()
install(FILES "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/CHANGELOG.md"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/nrd-dev" COMPONENT development)

# The sources, buildable without a shader compiler.
install(DIRECTORY cmake integration nrd rhi sample shaders tests DESTINATION . COMPONENT source EXCLUDE_FROM_ALL)
install(FILES CMakeLists.txt CMakePresets.json README.md LICENSE CHANGELOG.md DESTINATION . COMPONENT source
    EXCLUDE_FROM_ALL)

# cpack: .deb of runtime and development, .tar.gz of all three.
set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PACKAGE_VENDOR "The project's authors")
# Names under .invalid belong to nobody, by RFC 2606: a package that was built for oneself claims no one's address.
set(NRD_PACKAGE_CONTACT "nrd built from source <unmaintained@nrd.invalid>" CACHE STRING
    "Maintainer of the packages, 'name <address>': whoever distributes them sets it")
if(NOT NRD_PACKAGE_CONTACT MATCHES "^[^<>]*[^<> ] <[^<>@ ]+@[^<>@ ]+>$")
    message(FATAL_ERROR "NRD_PACKAGE_CONTACT is '${NRD_PACKAGE_CONTACT}', must be 'name <address>'")
endif()
set(CPACK_PACKAGE_CONTACT "${NRD_PACKAGE_CONTACT}")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_PACKAGING_INSTALL_PREFIX "/usr")
set(CPACK_COMPONENTS_ALL runtime development source)
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME nrd)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS "libc6, libgcc-s1, libstdc++6")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME nrd-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "nrd (= ${PROJECT_VERSION}), libvulkan-dev")
set(CPACK_PROJECT_CONFIG_FILE "${PROJECT_SOURCE_DIR}/cmake/CPackProject.cmake")
include(CPack)
