// Addresses of buffers in structs that C++ and GLSL share: BUFFER_ADDRESS(Floats) is a VkDeviceAddress to C++
// and a reference to the `buffer_reference` block `Floats` to GLSL. Include it in a shader before anything
// else, because it enables extensions. In a shader, read whole vectors from an array of vectors (`vec3 p[]`),
// and then their components. Mesa 22.3 has a bug: it returns x when a single component is read. Arrays of
// structs with vectors in them work.
#ifndef NEPHROID_GPU_BUFFER_ADDRESS_H
#define NEPHROID_GPU_BUFFER_ADDRESS_H

#ifdef __cplusplus
#include <cstdint>
#define BUFFER_ADDRESS(block) std::uint64_t
#else
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#define BUFFER_ADDRESS(block) block
#endif

#endif
