# Read by cpack for each generator: distributions get no sources, and those are not under a prefix.
if(CPACK_GENERATOR STREQUAL "DEB")
    set(CPACK_COMPONENTS_ALL runtime development)
else()
    set(CPACK_PACKAGING_INSTALL_PREFIX "/")
    set(CPACK_COMPONENT_INCLUDE_TOPLEVEL_DIRECTORY ON)
endif()
