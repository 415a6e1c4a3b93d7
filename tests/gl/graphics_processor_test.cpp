#include <gtest/gtest.h>

#include "gl/context.h"

namespace penumbra::gl {
namespace {

TEST(GraphicsProcessor, IsToldFromDriversThatDrawOnTheProcessor) {
  for (const char* name : {"llvmpipe (LLVM 15.0.6, 256 bits)", "softpipe", "Software Rasterizer",
                           "Google SwiftShader", ""})
    EXPECT_FALSE(is_graphics_processor(name)) << name;
  for (const char* name : {"NVIDIA GeForce RTX 3060/PCIe/SSE2", "AMD Radeon RX 6700 (radeonsi)",
                           "Mesa Intel(R) UHD Graphics 620 (KBL GT2)"})
    EXPECT_TRUE(is_graphics_processor(name)) << name;
}

}  // namespace
}  // namespace penumbra::gl
