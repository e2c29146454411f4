// SPDX-License-Identifier: Apache-2.0
#include <blosc.h>
#include <openvdb/io/Compression.h>

#include <bit>
#include <vector>

#include "io/vdb_stream.h"

namespace brume {
namespace {

// A tree on disk, depth first (OpenVDB 10, tree/RootNode.h, InternalNode.h, LeafNode.h):
//
//     1 | background | tiles | children | a tile: origin, value, active |
//     a child: origin, node of 32^3 = masks of children and values, its values,
//              a node of 16^3 for each child = the same, the mask of a leaf for each child |
//     every leaf again: mask, its values

using Mask = std::vector<std::uint64_t>;

class TreeCheck {
 public:
  TreeCheck(VdbStream& file, const ValueLayout& layout, std::uint32_t compression)
      : file_(file), layout_(layout), compression_(compression) {}

  void check() {
    if (file_.read<std::int32_t>() != 1) throw std::runtime_error("damaged tree");
    file_.skip(layout_.full);  // background
    const std::int64_t tiles = file_.read<std::uint32_t>();
    const std::int64_t children = file_.read<std::uint32_t>();
    file_.skip(tiles * (kOrigin + layout_.full + 1));
    for (std::int64_t i = 0; i < children; ++i) {
      file_.skip(kOrigin);
      check_upper_node();
    }
    for (std::int64_t i = 0; i < leaves_; ++i) check_values(read_mask(kLeafSize), kLeafSize);
  }

 private:
  static constexpr int kUpperSize = 32 * 32 * 32, kLowerSize = 16 * 16 * 16, kLeafSize = 8 * 8 * 8;
  static constexpr int kOrigin = 12;  // [bytes]

  void check_upper_node() {
    const std::int64_t children = check_internal_node(kUpperSize);
    for (std::int64_t i = 0; i < children; ++i) {
      const std::int64_t leaves = check_internal_node(kLowerSize);
      file_.skip(leaves * kLeafSize / 8);
      leaves_ += leaves;
    }
  }

  /// Returns the number of its children.
  std::int64_t check_internal_node(int size) {
    const Mask children = read_mask(size);
    const Mask active = read_mask(size);
    for (std::size_t i = 0; i < children.size(); ++i)
      if ((children[i] & active[i]) != 0) throw std::runtime_error("a child is a value too");
    check_values(active, size);
    return count(children);
  }

  void check_values(const Mask& active, int size) {
    using namespace openvdb::io;
    const int kind = file_.read<std::int8_t>();
    if (kind < NO_MASK_OR_INACTIVE_VALS || kind > NO_MASK_AND_ALL_VALS)
      throw std::runtime_error("damaged values");
    const bool two = kind == MASK_AND_TWO_INACTIVE_VALS;
    const bool one = kind == NO_MASK_AND_ONE_INACTIVE_VAL || kind == MASK_AND_ONE_INACTIVE_VAL;
    file_.skip((two ? 2 : one ? 1 : 0) * layout_.full);
    if (two || kind == MASK_AND_NO_INACTIVE_VALS || kind == MASK_AND_ONE_INACTIVE_VAL)
      file_.skip(size / 8);
    const bool only_active =
        (compression_ & COMPRESS_ACTIVE_MASK) != 0 && kind != NO_MASK_AND_ALL_VALS;
    check_block((only_active ? count(active) : size) * layout_.stored);
  }

  void check_block(std::int64_t bytes) {
    using namespace openvdb::io;
    const bool half = layout_.stored < layout_.full;
    if (half && bytes == 0) return;
    if ((compression_ & (COMPRESS_BLOSC | COMPRESS_ZIP)) == 0) {
      file_.skip(bytes);
      return;
    }
    const auto packed = file_.read<std::int64_t>();
    if (packed <= 0) {  // stored as it is
      if (packed != -bytes) throw std::runtime_error("damaged values");
      file_.skip(bytes);
    } else if ((compression_ & COMPRESS_BLOSC) != 0) {
      std::string block(std::size_t(file_.checked_length(packed)), '\0');
      file_.stream().read(block.data(), packed);
      std::size_t unpacked = 0;
      if (blosc_cbuffer_validate(block.data(), block.size(), &unpacked) != 0 ||
          std::int64_t(unpacked) < bytes)
        throw std::runtime_error("damaged values");
    } else {
      file_.skip(packed);
    }
  }

  Mask read_mask(int size) {
    Mask mask(std::size_t(size / 64));
    file_.stream().read(reinterpret_cast<char*>(mask.data()), size / 8);
    return mask;
  }

  static std::int64_t count(const Mask& mask) {
    std::int64_t on = 0;
    for (const std::uint64_t word : mask) on += std::popcount(word);
    return on;
  }

  VdbStream& file_;
  ValueLayout layout_;
  std::uint32_t compression_;
  std::int64_t leaves_ = 0;
};

}  // namespace

void check_tree(VdbStream& file, const ValueLayout& layout, std::uint32_t compression) {
  TreeCheck(file, layout, compression).check();
}

}  // namespace brume
