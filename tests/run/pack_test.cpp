#include "host/run/constants.h"
#include "tests/run/fixture.h"

#include <cstring>
#include <vector>

namespace tegument::run {
namespace {

Parameter parameter(BaseType base, int rows, int columns, int elements, const std::string& type) {
    return {.name = "gValue", .type = {.base = base, .rows = rows, .columns = columns, .elements = elements, .name = type}, .semantic = {}};
}

template <class T>
T at(const std::vector<std::byte>& block, std::size_t offset) {
    T value;
    std::memcpy(&value, block.data() + offset, sizeof value);
    return value;
}

TEST(Pack, a_column_major_matrix_is_stored_transposed) {
    const BlockMember member{
        .name = "gValue", .offset = 16, .size = 64, .rows = 4, .columns = 4, .matrixStride = 16, .spirvRowMajor = true};
    Numbers value(16);
    for (std::size_t i = 0; i < 16; ++i)
        value[i] = static_cast<double>(i);
    std::vector<std::byte> block(80);
    ASSERT_TRUE(pack(member, parameter(BaseType::Float, 4, 4, 0, "float4x4"), value, block));
    EXPECT_EQ(at<float>(block, 16 + 4), 4.0F) << "row 1, column 0 follows row 0, column 0";
    EXPECT_EQ(at<float>(block, 16 + 16), 1.0F) << "row 0, column 1 starts the second register";
}

TEST(Pack, a_row_major_matrix_is_stored_row_by_row) {
    const BlockMember member{
        .name = "gValue", .offset = 0, .size = 64, .rows = 4, .columns = 4, .matrixStride = 16, .spirvRowMajor = false};
    Numbers value(16);
    value[1] = 7;
    std::vector<std::byte> block(64);
    ASSERT_TRUE(pack(member, parameter(BaseType::Float, 4, 4, 0, "float4x4"), value, block));
    EXPECT_EQ(at<float>(block, 4), 7.0F);
}

TEST(Pack, array_elements_lie_a_stride_apart) {
    const BlockMember member{.name = "gValue", .offset = 32, .size = 36, .elements = 3, .arrayStride = 16};
    std::vector<std::byte> block(80);
    ASSERT_TRUE(pack(member, parameter(BaseType::Float, 1, 1, 3, "float"), {1, 2, 3}, block));
    EXPECT_EQ(at<float>(block, 32), 1.0F);
    EXPECT_EQ(at<float>(block, 48), 2.0F);
    EXPECT_EQ(at<float>(block, 64), 3.0F);
    EXPECT_EQ(at<std::uint32_t>(block, 36), 0U) << "the gap between elements is untouched";
}

TEST(Pack, integers_and_booleans_are_written_as_32_bit_integers) {
    std::vector<std::byte> block(12);
    ASSERT_TRUE(pack({.name = "gValue", .base = MemberBase::Int, .offset = 0}, parameter(BaseType::Int, 1, 1, 0, "int"), {-3}, block));
    ASSERT_TRUE(pack({.name = "gValue", .base = MemberBase::Uint, .offset = 4}, parameter(BaseType::Bool, 1, 1, 0, "bool"), {1}, block));
    ASSERT_TRUE(
        pack({.name = "gValue", .base = MemberBase::Uint, .offset = 8}, parameter(BaseType::Uint, 1, 1, 0, "uint"), {4294967295.0}, block));
    EXPECT_EQ(at<std::int32_t>(block, 0), -3);
    EXPECT_EQ(at<std::uint32_t>(block, 4), 1U);
    EXPECT_EQ(at<std::uint32_t>(block, 8), 4294967295U);
}

TEST(Pack, a_member_of_another_shape_than_the_parameter_is_an_error) {
    std::vector<std::byte> block(16);
    const auto packed = pack({.name = "gValue", .columns = 4}, parameter(BaseType::Float, 1, 3, 0, "float3"), {1, 2, 3}, block);
    EXPECT_EQ(test::code(packed), 4019);
}

} // namespace
} // namespace tegument::run
