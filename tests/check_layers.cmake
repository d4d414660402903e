# Script: fails on an #include that breaks the layers.  cmake -DROOT=... [-DSELF_TEST=ON] -P check_layers.cmake
cmake_minimum_required(VERSION 3.25)

# Each rule: files matching FILES (relative to ROOT) may not include what matches FORBIDDEN, unless they match EXCEPT.
set(rules "")
macro(forbid rule files forbidden except)
    list(APPEND rules ${rule})
    set(${rule}_FILES "${files}")
    set(${rule}_FORBIDDEN "${forbidden}")
    set(${rule}_EXCEPT "${except}")
endmacro()

set(vulkan "vulkan/|vulkan\\.h|volk\\.h|vk_")
set(content "tiny_gltf|GLFW/|OpenEXR/|Imf|stb_|imgui|embree|glm/|nlohmann/|CLI/")
set(none "^$")
forbid(nrd_knows_no_graphics "^nrd/" "${vulkan}|^rhi/|${content}" "${none}")
forbid(nrd_knows_no_upper_layer "^nrd/" "^nrd/(integration|plugin)|(^|/)(sample|integration|tests)/|catch2/" "${none}")
forbid(rhi_knows_no_denoiser "^rhi/" "^nrd/|nrd_shaders|(^|/)(sample|integration|tests)/|${content}|catch2/" "${none}")
forbid(vulkan_only_in_its_backend "^rhi/" "${vulkan}" "^rhi/src/vulkan/|^rhi/include/rhi/vulkan\\.h$")
forbid(integration_knows_no_sample "^integration/" "(^|/)(sample|tests)/|${content}|catch2/" "^integration/examples/")
forbid(sample_uses_vulkan_not_rhi "^sample/" "^rhi/|nrd/src/|(^|/)tests/|catch2/" "${none}")
forbid(shader_library_knows_no_family "^shaders/(lib|shared|include)/" "(reblur|relax|sigma|reference|common)/" "${none}")
foreach(family reblur relax sigma reference)
    set(others reblur relax sigma reference)
    list(REMOVE_ITEM others ${family})
    string(REPLACE ";" "|" others "${others}")
    forbid(${family}_knows_no_other_family "^shaders/${family}/" "(^|/)(${others})(/|\\.glsl|_constants\\.h)" "${none}")
endforeach()

# "file: rule (include)" of every violation under root.
function(find_violations root out)
    file(GLOB_RECURSE files RELATIVE "${root}" "${root}/nrd/*" "${root}/rhi/*" "${root}/integration/*"
        "${root}/sample/*" "${root}/shaders/*")
    list(FILTER files INCLUDE REGEX "\\.(h|hpp|cpp|c|glsl)$")
    set(violations "")
    foreach(file IN LISTS files)
        file(STRINGS "${root}/${file}" lines REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"]")
        foreach(line IN LISTS lines)
            string(REGEX REPLACE "^[ \t]*#[ \t]*include[ \t]*[<\"]([^>\"]*)[>\"].*$" "\\1" include "${line}")
            foreach(rule IN LISTS rules)
                if(file MATCHES "${${rule}_FILES}" AND NOT file MATCHES "${${rule}_EXCEPT}"
                   AND include MATCHES "${${rule}_FORBIDDEN}")
                    list(APPEND violations "${file}: ${rule} (${include})")
                endif()
            endforeach()
        endforeach()
    endforeach()
    list(LENGTH files num)
    set(${out} "${violations}" PARENT_SCOPE)
    set(${out}_FILE_NUM ${num} PARENT_SCOPE)
endfunction()

if(NOT SELF_TEST)
    find_violations("${ROOT}" violations)
    if(violations_FILE_NUM EQUAL 0)
        message(FATAL_ERROR "no sources under ${ROOT}")
    endif()
    list(JOIN violations "\n  " text)
    if(violations)
        message(FATAL_ERROR "includes that break the layers:\n  ${text}")
    endif()
    message(STATUS "${violations_FILE_NUM} files keep the layers")
    return()
endif()

# file, include, and the rule it must break; - = none
set(cases
    "nrd/src/a.cpp|vulkan/vulkan.h|nrd_knows_no_graphics"
    "nrd/src/b.cpp|rhi/device.h|nrd_knows_no_graphics"
    "nrd/src/c.cpp|nrd/integration.h|nrd_knows_no_upper_layer"
    "nrd/src/d.cpp|reblur_constants.h|-"
    "rhi/src/barriers.cpp|vulkan/vulkan_core.h|vulkan_only_in_its_backend"
    "rhi/src/vulkan/device.cpp|vulkan/vulkan.h|-"
    "rhi/include/rhi/vulkan.h|vulkan/vulkan_core.h|-"
    "rhi/src/a.cpp|nrd/types.h|rhi_knows_no_denoiser"
    "integration/src/a.cpp|tiny_gltf.h|integration_knows_no_sample"
    "integration/src/b.cpp|rhi/device.h|-"
    "sample/a.cpp|rhi/device.h|sample_uses_vulkan_not_rhi"
    "sample/b.cpp|nrd/integration.h|-"
    "shaders/lib/a.glsl|reblur/x.glsl|shader_library_knows_no_family"
    "shaders/reblur/a.comp.glsl|relax_constants.h|reblur_knows_no_other_family"
    "shaders/reblur/b.comp.glsl|reblur_constants.h|-")
file(REMOVE_RECURSE "${ROOT}")
foreach(case IN LISTS cases)
    string(REPLACE "|" ";" case "${case}")
    list(GET case 0 file)
    list(GET case 1 include)
    file(APPEND "${ROOT}/${file}" "#include <${include}>\n")
endforeach()
find_violations("${ROOT}" violations)
foreach(case IN LISTS cases)
    string(REPLACE "|" ";" case "${case}")
    list(GET case 0 file)
    list(GET case 1 include)
    list(GET case 2 rule)
    set(found "${violations}")
    list(FILTER found INCLUDE REGEX "^${file}:")
    if(rule STREQUAL "-" AND found)
        message(FATAL_ERROR "${file} including ${include} is allowed, but was reported: ${found}")
    elseif(NOT rule STREQUAL "-" AND NOT "${file}: ${rule} (${include})" IN_LIST found)
        message(FATAL_ERROR "${file} including ${include} breaks ${rule}, but was not found")
    endif()
endforeach()
message(STATUS "every violation was found")
