#include "tests/support/allocation_count.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::uint64_t> allocations{0};
thread_local std::uint64_t allocations_of_thread = 0;

void count() noexcept {
    allocations.fetch_add(1, std::memory_order_relaxed);
    ++allocations_of_thread;
}

}  // namespace

// The standard library's other forms end in these.
void* operator new(std::size_t size) {
    count();
    if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
    throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    count();
    const auto step = static_cast<std::size_t>(alignment);
    if (void* memory = std::aligned_alloc(step, (size + step) / step * step)) return memory;
    throw std::bad_alloc();
}
// The sanitizers bring their own of these, which do not end in ours.
void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
    count();
    return std::malloc(size == 0 ? 1 : size);
}
void operator delete(void* memory, const std::nothrow_t& /*tag*/) noexcept {
    std::free(memory);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t /*size*/) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept {
    std::free(memory);
}

namespace skyig::tests {

std::uint64_t allocation_count() noexcept {
    return allocations.load(std::memory_order_relaxed);
}

std::uint64_t allocation_count_of_this_thread() noexcept {
    return allocations_of_thread;
}

}  // namespace skyig::tests
