#include "gltf_accessor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <tiny_gltf.h>

namespace sample
{
namespace
{
constexpr size_t kMaxCount = size_t(1) << 28; // elements; a larger accessor is taken for a broken one
constexpr size_t kMaxZeroCount = size_t(1)
                                 << 22; // of an accessor without a buffer view, whose zeros cost nothing on disk

// A run of equally spaced elements that lies inside its buffer.
struct ElementRange
{
    const uint8_t* data = nullptr;
    size_t stride = 0;
    const uint8_t* at(size_t i) const { return data + i * stride; }
};

[[noreturn]] void fail(const std::string& what, const std::string& problem) { throw SceneError(what + ": " + problem); }

ElementRange findRange(const tinygltf::Model& model, int viewIndex, size_t offset, size_t elementSize, size_t count,
                       const std::string& what)
{
    if (viewIndex < 0 || size_t(viewIndex) >= model.bufferViews.size())
        fail(what, "buffer view " + std::to_string(viewIndex) + " does not exist");
    const tinygltf::BufferView& view = model.bufferViews[size_t(viewIndex)];
    if (view.buffer < 0 || size_t(view.buffer) >= model.buffers.size())
        fail(what, "buffer " + std::to_string(view.buffer) + " does not exist");
    const std::vector<unsigned char>& bytes = model.buffers[size_t(view.buffer)].data;
    if (view.byteOffset > bytes.size() || view.byteLength > bytes.size() - view.byteOffset)
        fail(what, "buffer view " + std::to_string(viewIndex) + " reaches beyond its buffer");
    const size_t stride = view.byteStride ? view.byteStride : elementSize;
    if (stride < elementSize || stride > 1024) fail(what, "the stride of its buffer view is out of range");
    if (count == 0) return {};
    const size_t needed = (count - 1) * stride + elementSize; // below 2^39: count and stride are bounded
    if (offset > view.byteLength || needed > view.byteLength - offset)
        fail(what, "the accessor reaches beyond buffer view " + std::to_string(viewIndex));
    return {bytes.data() + view.byteOffset + offset, stride};
}

template <class S> S load(const uint8_t* bytes)
{
    S value;
    std::memcpy(&value, bytes, sizeof(S)); // accessors need not be aligned in a broken file
    return value;
}

size_t componentSize(int type, const std::string& what)
{
    switch (type)
    {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return 4;
    default:
        fail(what, "component type " + std::to_string(type) + " is not one of glTF 2.0");
    }
}

float toFloat(const uint8_t* bytes, int type, bool isNormalized)
{
    switch (type)
    {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return isNormalized ? std::max(float(load<int8_t>(bytes)) / 127.0f, -1.0f) : float(load<int8_t>(bytes));
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return float(*bytes) / (isNormalized ? 255.0f : 1.0f);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return isNormalized ? std::max(float(load<int16_t>(bytes)) / 32767.0f, -1.0f) : float(load<int16_t>(bytes));
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return float(load<uint16_t>(bytes)) / (isNormalized ? 65535.0f : 1.0f);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return float(load<uint32_t>(bytes));
    default:
        return load<float>(bytes);
    }
}

uint32_t toInteger(const uint8_t* bytes, int type)
{
    switch (type)
    {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return *bytes;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return load<uint16_t>(bytes);
    default:
        return load<uint32_t>(bytes);
    }
}

// What an accessor's elements look like in memory.
struct ElementLayout
{
    size_t components = 0;
    size_t componentBytes = 0;
    size_t bytes() const { return components * componentBytes; }
};

ElementLayout findLayout(const tinygltf::Accessor& accessor, const std::string& what)
{
    const int components = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type));
    if (components < 1) fail(what, "its accessor has an unknown type");
    if (accessor.count > (accessor.bufferView >= 0 ? kMaxCount : kMaxZeroCount))
        fail(what, "its accessor claims too many elements");
    return {size_t(components), componentSize(accessor.componentType, what)};
}

// The sparse part: which elements it replaces, and where their values are.
struct SparsePart
{
    std::vector<uint32_t> targets; // each below the accessor's count
    ElementRange values;
};

SparsePart findSparse(const tinygltf::Model& model, const tinygltf::Accessor& accessor, size_t elementSize,
                      const std::string& what)
{
    if (!accessor.sparse.isSparse) return {};
    const auto& sparse = accessor.sparse;
    if (sparse.count < 0 || size_t(sparse.count) > accessor.count)
        fail(what, "the sparse part of its accessor has more elements than the accessor");
    const size_t count = size_t(sparse.count);
    const int type = sparse.indices.componentType;
    const ElementRange indices =
        findRange(model, sparse.indices.bufferView, size_t(std::max(sparse.indices.byteOffset, 0)),
                  componentSize(type, what), count, what);
    SparsePart part;
    part.values = findRange(model, sparse.values.bufferView, size_t(std::max(sparse.values.byteOffset, 0)), elementSize,
                            count, what);
    for (size_t i = 0; i < count; ++i)
    {
        part.targets.push_back(toInteger(indices.at(i), type));
        if (part.targets.back() >= accessor.count)
            fail(what, "the sparse part of its accessor writes element " + std::to_string(part.targets.back()) +
                           " of " + std::to_string(accessor.count));
    }
    return part;
}

// Reads all elements, then overwrites those of the sparse part. `convert` makes a T of one component's bytes.
template <class T, class Convert>
AccessorData<T> readElements(const tinygltf::Model& model, int index, const std::string& what, Convert convert)
{
    if (index < 0 || size_t(index) >= model.accessors.size())
        fail(what, "accessor " + std::to_string(index) + " does not exist");
    const tinygltf::Accessor& accessor = model.accessors[size_t(index)];
    const ElementLayout layout = findLayout(accessor, what);
    ElementRange dense;
    if (accessor.bufferView >= 0)
        dense = findRange(model, accessor.bufferView, accessor.byteOffset, layout.bytes(), accessor.count, what);
    const SparsePart sparse = findSparse(model, accessor, layout.bytes(), what);

    AccessorData<T> result;
    result.componentCount = static_cast<uint32_t>(layout.components);
    result.count = accessor.count;
    result.values.resize(accessor.count * layout.components); // after the checks: a lie must not cost memory
    const auto copy = [&](const uint8_t* from, size_t to)
    {
        for (size_t c = 0; c < layout.components; ++c)
            result.values[to * layout.components + c] =
                convert(from + c * layout.componentBytes, accessor.componentType, accessor.normalized);
    };
    for (size_t i = 0; dense.data && i < accessor.count; ++i) copy(dense.at(i), i);
    for (size_t i = 0; i < sparse.targets.size(); ++i) copy(sparse.values.at(i), sparse.targets[i]);
    return result;
}
} // namespace

AccessorData<float> readFloats(const tinygltf::Model& model, int index, const std::string& what)
{
    AccessorData<float> data = readElements<float>(model, index, what, toFloat);
    for (size_t i = 0; i < data.values.size(); ++i)
    {
        if (!std::isfinite(data.values[i]))
            fail(what, "element " + std::to_string(i / data.componentCount) + " is not a finite number");
    }
    return data;
}

AccessorData<uint32_t> readIntegers(const tinygltf::Model& model, int index, const std::string& what)
{
    if (index >= 0 && size_t(index) < model.accessors.size())
    {
        const int type = model.accessors[size_t(index)].componentType;
        if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
            type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
            fail(what, "accessor " + std::to_string(index) + " does not hold unsigned integers");
    }
    return readElements<uint32_t>(model, index, what,
                                  [](const uint8_t* bytes, int type, bool) { return toInteger(bytes, type); });
}
} // namespace sample
