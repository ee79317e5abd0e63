// SPDX-License-Identifier: Apache-2.0
// The parts of a C++ library that the tests (never the core) need and this compiler lacks: heap by operator new, the
// tree of the ordered containers, and replacements of functions that would throw.
#include <cstdio>
#include <cstdlib>
#include <map>
#include <new>
#include <utility>

#include "firmware/board/qemu_virt/machine.hpp"

// An exhausted heap ends the run in sbrk.
void* operator new(std::size_t size) { return std::malloc(size); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return std::malloc(size); }
void* operator new[](std::size_t size) { return operator new(size); }
void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }
void operator delete(void* block, const std::nothrow_t&) noexcept { std::free(block); }
void operator delete[](void* block) noexcept { std::free(block); }
void operator delete[](void* block, std::size_t) noexcept { std::free(block); }

namespace std {

const nothrow_t nothrow{};

namespace {

[[noreturn]] void stop(const char* what) {
  std::printf("would have thrown: %s\n", what);
  pharos::board::exit_emulator(1);
}

using Node = _Rb_tree_node_base;

// The next node in order; `Near` and `Far` are the child pointers towards and away from it. The header's parent is the
// root and the root's parent is the header.
template <Node* Node::*Far, Node* Node::*Near>
Node* neighbour(Node* node) {
  if (node->*Far != nullptr) {
    node = node->*Far;
    while (node->*Near != nullptr) node = node->*Near;
    return node;
  }
  Node* parent = node->_M_parent;
  while (node == parent->*Far) {
    node = parent;
    parent = parent->_M_parent;
  }
  // From the greatest node the way upwards passes the root and ends at the header.
  return node->*Far != parent ? parent : node;
}

}  // namespace

void __throw_length_error(const char* what) { stop(what); }
void __throw_out_of_range_fmt(const char* what, ...) { stop(what); }
void __throw_logic_error(const char* what) { stop(what); }
void __throw_bad_alloc() { stop("bad_alloc"); }
void __throw_bad_array_new_length() { stop("bad_array_new_length"); }
void __throw_bad_function_call() { stop("bad_function_call"); }

Node* _Rb_tree_increment(Node* node) noexcept { return neighbour<&Node::_M_right, &Node::_M_left>(node); }
const Node* _Rb_tree_increment(const Node* node) noexcept { return _Rb_tree_increment(const_cast<Node*>(node)); }
Node* _Rb_tree_decrement(Node* node) noexcept {
  // From end(): the header, the only red node whose grandparent it is itself.
  if (node->_M_color == _S_red && node->_M_parent->_M_parent == node) return node->_M_right;
  return neighbour<&Node::_M_left, &Node::_M_right>(node);
}
const Node* _Rb_tree_decrement(const Node* node) noexcept { return _Rb_tree_decrement(const_cast<Node*>(node)); }

// A search tree without balancing, because the tests' sets are small. There is no erase().
void _Rb_tree_insert_and_rebalance(const bool left, Node* node, Node* parent, Node& header) noexcept {
  node->_M_parent = parent;
  node->_M_left = node->_M_right = nullptr;
  node->_M_color = _S_black;
  if (parent == &header) {
    header._M_parent = header._M_left = header._M_right = node;
  } else if (left) {
    parent->_M_left = node;
    if (parent == header._M_left) header._M_left = node;
  } else {
    parent->_M_right = node;
    if (parent == header._M_right) header._M_right = node;
  }
}

}  // namespace std
