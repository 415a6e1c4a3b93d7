// Memory for large trees: on huge pages where the system has them, for a walk touches a page at
// nearly every step and would otherwise spend a good part of its time on address translation.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

namespace penumbra {

template <class T>
struct HugePageAllocator {
  using value_type = T;
  HugePageAllocator() = default;
  template <class U>
  HugePageAllocator(const HugePageAllocator<U>& /*other*/) {}

  T* allocate(std::size_t n) {
    constexpr std::size_t page = std::size_t{1} << 21, line = 64;
    const std::size_t bytes = n * sizeof(T), unit = bytes >= page ? page : line;
    void* memory = std::aligned_alloc(unit, (bytes + unit - 1) / unit * unit);
    if (!memory) throw std::bad_alloc();
    if (unit == page) madvise(memory, bytes, MADV_HUGEPAGE);  // advice: may be refused
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t /*n*/) { std::free(memory); }
  friend bool operator==(const HugePageAllocator&, const HugePageAllocator&) { return true; }
};

template <class T>
using HugeVector = std::vector<T, HugePageAllocator<T>>;

}  // namespace penumbra
