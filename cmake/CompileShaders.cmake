# GLSL -> SPIR-V (glslang) -> spirv-opt -> C++ arrays. A shader library is a list of nrd_add_shader() lines between
# nrd_shader_library() and nrd_end_shader_library(); each line is one Shader enumerator, so that a missing permutation
# does not compile. Identical work is not repeated: each line has its own outputs and a dependency file.
#
# Without a shader compiler: NRD_SPIRV_DIR is a folder with released modules, as TARGET/Name.spv. An archive of the
# sources has it beside them; cmake --install leaves it in share/nrd/spirv.
set(NRD_RELEASED_SPIRV "")
if(EXISTS "${PROJECT_SOURCE_DIR}/spirv")
    set(NRD_RELEASED_SPIRV "${PROJECT_SOURCE_DIR}/spirv")
endif()
set(NRD_SPIRV_DIR "${NRD_RELEASED_SPIRV}" CACHE PATH "Folder with released SPIR-V, so that no shader is compiled")
set(required REQUIRED)
if(NRD_SPIRV_DIR)
    set(required "") # but for what has shaders of its own: the sample and the tests
endif()
find_program(NRD_GLSLANG NAMES glslangValidator glslang ${required})
find_program(NRD_SPIRV_OPT NAMES spirv-opt ${required})

# nrd_shader_library(TARGET NAMESPACE ns INCLUDES dirs...)
function(nrd_shader_library target)
    cmake_parse_arguments(ARG "" "NAMESPACE" "INCLUDES" ${ARGN})
    set_property(DIRECTORY PROPERTY NRD_SHADER_TARGET ${target})
    set_property(DIRECTORY PROPERTY NRD_SHADER_NAMESPACE ${ARG_NAMESPACE})
    set_property(DIRECTORY PROPERTY NRD_SHADER_INCLUDES ${ARG_INCLUDES})
    set_property(DIRECTORY PROPERTY NRD_SHADER_NAMES "")
    set_property(DIRECTORY PROPERTY NRD_SHADER_SOURCES "")
    set_property(DIRECTORY PROPERTY NRD_SHADER_MANIFEST "")
    set_property(DIRECTORY PROPERTY NRD_SHADER_MODULES "")
endfunction()

# nrd_add_shader(Name file.comp.glsl DEFINES A=1 B=2); .hlsl for HLSL
function(nrd_add_shader name file)
    cmake_parse_arguments(ARG "" "" "DEFINES" ${ARGN})
    get_property(target DIRECTORY PROPERTY NRD_SHADER_TARGET)
    get_property(namespace DIRECTORY PROPERTY NRD_SHADER_NAMESPACE)
    get_property(includes DIRECTORY PROPERTY NRD_SHADER_INCLUDES)
    set(source "${CMAKE_CURRENT_SOURCE_DIR}/${file}")
    set(stem "${CMAKE_CURRENT_BINARY_DIR}/${target}/${name}")
    string(REPLACE ";" "\", \"" json_defines "${ARG_DEFINES}")
    if(json_defines)
        set(json_defines "\"${json_defines}\"")
    endif()
    set_property(DIRECTORY APPEND PROPERTY NRD_SHADER_NAMES ${name})
    set_property(DIRECTORY APPEND PROPERTY NRD_SHADER_SOURCES "${stem}.cpp")
    set_property(DIRECTORY APPEND PROPERTY NRD_SHADER_MANIFEST
        "    { \"name\": \"${name}\", \"file\": \"${file}\", \"defines\": [${json_defines}] }")
    if(NRD_SPIRV_DIR AND (EXISTS "${NRD_SPIRV_DIR}/${target}/${name}.spv" OR NOT NRD_GLSLANG))
        nrd_embed_released_shader(${target} ${name} ${namespace})
        return()
    endif()
    set(language --glsl-version 460)
    if(file MATCHES "\\.hlsl$")
        set(language -D -D__HLSL_VERSION=2021 -e main)
    endif()
    list(TRANSFORM includes PREPEND "-I")
    list(TRANSFORM ARG_DEFINES PREPEND "-D" OUTPUT_VARIABLE defines)
    add_custom_command(
        OUTPUT "${stem}.raw.spv" # the name glslang writes into the dependency file
        COMMAND "${CMAKE_COMMAND}" -E make_directory "${CMAKE_CURRENT_BINARY_DIR}/${target}"
        COMMAND "${NRD_GLSLANG}" --quiet --target-env vulkan1.1 ${language} -S comp ${includes} ${defines}
                --depfile "${stem}.d" -o "${stem}.raw.spv" "${source}"
        DEPFILE "${stem}.d"
        DEPENDS "${source}"
        COMMENT "Shader ${name}"
        VERBATIM)
    add_custom_command(
        OUTPUT "${stem}.cpp"
        COMMAND "${NRD_SPIRV_OPT}" -O "${stem}.raw.spv" -o "${stem}.spv"
        COMMAND "${CMAKE_COMMAND}" -DINPUT=${stem}.spv -DOUTPUT=${stem}.cpp -DNAME=${name} -DNAMESPACE=${namespace}
                -P "${PROJECT_SOURCE_DIR}/cmake/EmbedSpirv.cmake"
        DEPENDS "${stem}.raw.spv" "${PROJECT_SOURCE_DIR}/cmake/EmbedSpirv.cmake"
        COMMENT "Embedding ${name}"
        VERBATIM)
    set_property(DIRECTORY APPEND PROPERTY NRD_SHADER_MODULES "${stem}.spv")
endfunction()

function(nrd_embed_released_shader target name namespace)
    set(module "${NRD_SPIRV_DIR}/${target}/${name}.spv")
    if(NOT EXISTS "${module}")
        message(FATAL_ERROR "NRD_SPIRV_DIR has no ${target}/${name}.spv, and there is no glslangValidator: the folder "
            "is of another version, or what is built has shaders of its own, as the sample and the tests have")
    endif()
    set(output "${CMAKE_CURRENT_BINARY_DIR}/${target}/${name}.cpp")
    add_custom_command(
        OUTPUT "${output}"
        COMMAND "${CMAKE_COMMAND}" -DINPUT=${module} -DOUTPUT=${output} -DNAME=${name} -DNAMESPACE=${namespace}
                -P "${PROJECT_SOURCE_DIR}/cmake/EmbedSpirv.cmake"
        DEPENDS "${module}" "${PROJECT_SOURCE_DIR}/cmake/EmbedSpirv.cmake"
        COMMENT "Embedding ${name}"
        VERBATIM)
    set_property(DIRECTORY APPEND PROPERTY NRD_SHADER_MODULES "${module}")
endfunction()

# Writes the Shader enum, the table of blobs and the manifest, and creates the static library.
function(nrd_end_shader_library)
    get_property(target DIRECTORY PROPERTY NRD_SHADER_TARGET)
    get_property(namespace DIRECTORY PROPERTY NRD_SHADER_NAMESPACE)
    get_property(names DIRECTORY PROPERTY NRD_SHADER_NAMES)
    get_property(sources DIRECTORY PROPERTY NRD_SHADER_SOURCES)
    get_property(manifest DIRECTORY PROPERTY NRD_SHADER_MANIFEST)
    set(out "${CMAKE_CURRENT_BINARY_DIR}/${target}")
    set(enumerators "")
    set(declarations "")
    set(rows "")
    foreach(name IN LISTS names)
        string(APPEND enumerators "    ${name},\n")
        string(APPEND declarations "extern const uint32_t k${name}[];\nextern const size_t k${name}Size;\n")
        string(APPEND rows "    case Shader::${name}: return {\"${name}\", k${name}, k${name}Size};\n")
    endforeach()
    file(CONFIGURE OUTPUT "${out}/include/${target}.h" @ONLY CONTENT
"// Generated from the nrd_add_shader() lines.
#pragma once
#include <cstddef>
#include <cstdint>

namespace @namespace@
{
enum class Shader : uint16_t
{
@enumerators@    Count
};

struct ShaderBlob
{
    const char* name;
    const uint32_t* words; // SPIR-V
    size_t byteSize;
};

ShaderBlob shaderBlob(Shader shader); // words is null for Shader::Count
} // namespace @namespace@
")
    file(CONFIGURE OUTPUT "${out}/${target}.cpp" @ONLY CONTENT
"#include \"@target@.h\"

namespace @namespace@
{
@declarations@
ShaderBlob shaderBlob(Shader shader)
{
    switch (shader)
    {
@rows@    case Shader::Count: break;
    }
    return {\"\", nullptr, 0};
}
} // namespace @namespace@
")
    string(REPLACE ";" ",\n" manifest "${manifest}")
    get_property(includes DIRECTORY PROPERTY NRD_SHADER_INCLUDES)
    list(TRANSFORM includes REPLACE "^${CMAKE_CURRENT_SOURCE_DIR}/(.*)$" "\"\\1\"")
    string(REPLACE ";" ", " includes "${includes}")
    file(CONFIGURE OUTPUT "${out}/${target}.json" @ONLY CONTENT
"{
  \"includes\": [@includes@],
  \"targetEnvironment\": \"vulkan1.1\",
  \"optimizer\": \"performance\",
  \"shaders\": [
@manifest@
  ]
}
")
    add_library(${target} STATIC "${out}/${target}.cpp" ${sources})
    target_include_directories(${target} PUBLIC "${out}/include")
    get_property(modules DIRECTORY PROPERTY NRD_SHADER_MODULES)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden
        NRD_MANIFEST "${out}/${target}.json" NRD_MODULES "${modules}")
endfunction()

# The objects of a shader library within another library, which so needs nothing but itself.
function(nrd_include_shaders library target)
    target_sources(${library} PRIVATE $<TARGET_OBJECTS:${target}>)
    target_include_directories(${library} PRIVATE $<TARGET_PROPERTY:${target},INTERFACE_INCLUDE_DIRECTORIES>)
endfunction()
