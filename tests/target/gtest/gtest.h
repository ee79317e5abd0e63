// SPDX-License-Identifier: Apache-2.0
#pragma once

// The part of GoogleTest's interface that the core's tests use, for a target that has no C++ library to link the real
// one: the same test sources compile on the host against GoogleTest and here against this file. The heap belongs to the
// tests (cxx_library.cpp); the core under test has none.
#include <cmath>
#include <concepts>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "tests/target/gtest/show.hpp"

namespace testing {

class Test {
 public:
  Test() = default;
  Test(const Test&) = delete;
  Test& operator=(const Test&) = delete;
  virtual ~Test() = default;

  virtual void SetUp() {}
  virtual void TearDown() {}
  virtual void TestBody() = 0;

  static void RecordProperty(const char* key, int value);
};

template <class T>
class TestWithParam : public Test {
 public:
  using ParamType = T;
  static const T& GetParam() { return *parameter; }
  static inline const T* parameter = nullptr;
};

template <class T>
struct TestParamInfo {
  T param;
  std::size_t index;
};

/// Message that a test adds to a check.
class Message {
 public:
  template <class T>
  Message& operator<<(const T& value) {
    text_ += internal::show(value);
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

template <class... T>
std::vector<std::common_type_t<T...>> Values(T... values) {
  return {values...};
}

namespace internal {

struct Case {
  std::string name;
  std::function<std::unique_ptr<Test>()> make;
};
/// Every case of the image, in the order of the sources.
std::vector<Case>& cases();
/// Ends the run because of an error in the tests themselves.
[[noreturn]] void broken(const char* what);

/// A check that failed (or a skip); printed when the message of the test is assigned to it.
class Verdict {
 public:
  enum Kind { kFailed, kSkipped };

  Verdict(Kind kind, const char* file, int line, std::string what)
      : kind_(kind), file_(file), line_(line), what_(std::move(what)) {}
  void operator=(const Message& message) const;

 private:
  Kind kind_;
  const char* file_;
  int line_;
  std::string what_;
};

// Each check returns its failure message; an empty string when it passes.
template <class Holds, class A, class B>
std::string compare(const char* a_text, const char* relation, const char* b_text, const A& a, const B& b) {
  if (Holds()(a, b)) return {};
  return std::string("expected ") + a_text + relation + b_text + "; they are " + show(a) + " and " + show(b);
}

template <class T>
std::string is(bool wanted, const char* text, const T& value) {
  if (static_cast<bool>(value) == wanted) return {};
  return std::string("expected ") + text + (wanted ? " to be true" : " to be false");
}

inline std::string is_near(const char* a_text, const char* b_text, double a, double b, double tolerance) {
  if (std::abs(a - b) <= tolerance) return {};
  return std::string("expected ") + a_text + " within " + show(tolerance) + " of " + b_text + "; they are " + show(a) +
         " and " + show(b);
}

/// Equal as in GoogleTest: at most four representable values apart.
struct EqualDoubles {
  bool operator()(double a, double b) const;
};

/// One of the cases of a parametrised suite.
template <class Suite>
struct ParametrisedCase {
  const char* name;
  std::unique_ptr<Test> (*make)();
};
template <class Suite>
std::vector<ParametrisedCase<Suite>>& parametrised_cases() {
  static std::vector<ParametrisedCase<Suite>> list;
  return list;
}

template <class T>
std::unique_ptr<Test> make_test() {
  return std::make_unique<T>();
}

template <class T>
bool add_case(const char* suite, const char* name) {
  cases().push_back({std::string(suite) + "." + name, make_test<T>});
  return true;
}

template <class Suite, class T>
bool add_parametrised(const char* name) {
  parametrised_cases<Suite>().push_back({name, make_test<T>});
  return true;
}

template <class T>
std::string number_of(const TestParamInfo<T>& info) {
  return std::to_string(info.index);
}

/// Must follow the suite's TEST_P in the file.
template <class Suite, class Value = typename Suite::ParamType>
bool instantiate(
    const char* prefix, const char* suite, const std::vector<std::type_identity_t<Value>>& values,
    const std::function<std::string(const TestParamInfo<std::type_identity_t<Value>>&)>& name_of = number_of<Value>) {
  if (parametrised_cases<Suite>().empty()) broken("INSTANTIATE_TEST_SUITE_P stands before its TEST_P");
  for (const auto& test : parametrised_cases<Suite>()) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      cases().push_back({std::string(prefix) + "/" + suite + "." + test.name + "/" + name_of({values[i], i}),
                         [make = test.make, value = values[i]] {
                           static Value current;
                           current = value;
                           Suite::parameter = &current;
                           return make();
                         }});
    }
  }
  return true;
}

}  // namespace internal
}  // namespace testing

#define PHAROS_TEST_CLASS(suite, name) suite##_##name##_Test
// The other arguments are the call that registers the case.
#define PHAROS_TEST_OF(suite, name, base, ...)                                                  \
  class PHAROS_TEST_CLASS(suite, name) : public base {                                          \
    void TestBody() override;                                                                   \
  };                                                                                            \
  [[maybe_unused]] static const bool suite##_##name##_added = ::testing::internal::__VA_ARGS__; \
  void PHAROS_TEST_CLASS(suite, name)::TestBody()

#define TEST(suite, name) \
  PHAROS_TEST_OF(suite, name, ::testing::Test, add_case<PHAROS_TEST_CLASS(suite, name)>(#suite, #name))
#define TEST_F(suite, name) PHAROS_TEST_OF(suite, name, suite, add_case<PHAROS_TEST_CLASS(suite, name)>(#suite, #name))
#define TEST_P(suite, name) \
  PHAROS_TEST_OF(suite, name, suite, add_parametrised<suite, PHAROS_TEST_CLASS(suite, name)>(#name))
#define INSTANTIATE_TEST_SUITE_P(prefix, suite, ...)           \
  [[maybe_unused]] static const bool prefix##_##suite##_made = \
      ::testing::internal::instantiate<suite>(#prefix, #suite, __VA_ARGS__)

#define PHAROS_VERDICT(kind, what) \
  ::testing::internal::Verdict(::testing::internal::Verdict::kind, __FILE__, __LINE__, what) = ::testing::Message()
// The switch prevents an `else` after the check from binding to its `if`.
#define PHAROS_CHECK(what, on_failure)                                                  \
  switch (0)                                                                            \
  case 0:                                                                               \
  default:                                                                              \
    if (const std::string pharos_what = ::testing::internal::what; pharos_what.empty()) \
      ;                                                                                 \
    else                                                                                \
      on_failure PHAROS_VERDICT(kFailed, pharos_what)

#define PHAROS_COMPARE(holds, relation, a, b, on_failure) \
  PHAROS_CHECK(compare<holds>(#a, relation, #b, a, b), on_failure)

#define EXPECT_EQ(a, b) PHAROS_COMPARE(std::equal_to<>, " == ", a, b, )
#define EXPECT_NE(a, b) PHAROS_COMPARE(std::not_equal_to<>, " != ", a, b, )
#define EXPECT_LT(a, b) PHAROS_COMPARE(std::less<>, " < ", a, b, )
#define EXPECT_LE(a, b) PHAROS_COMPARE(std::less_equal<>, " <= ", a, b, )
#define EXPECT_GT(a, b) PHAROS_COMPARE(std::greater<>, " > ", a, b, )
#define EXPECT_GE(a, b) PHAROS_COMPARE(std::greater_equal<>, " >= ", a, b, )
#define EXPECT_DOUBLE_EQ(a, b) PHAROS_COMPARE(::testing::internal::EqualDoubles, " == ", a, b, )
#define EXPECT_TRUE(a) PHAROS_CHECK(is(true, #a, a), )
#define EXPECT_FALSE(a) PHAROS_CHECK(is(false, #a, a), )
#define EXPECT_NEAR(a, b, tolerance) PHAROS_CHECK(is_near(#a, #b, a, b, tolerance), )

#define ASSERT_EQ(a, b) PHAROS_COMPARE(std::equal_to<>, " == ", a, b, return )
#define ASSERT_NE(a, b) PHAROS_COMPARE(std::not_equal_to<>, " != ", a, b, return )
#define ASSERT_LT(a, b) PHAROS_COMPARE(std::less<>, " < ", a, b, return )
#define ASSERT_LE(a, b) PHAROS_COMPARE(std::less_equal<>, " <= ", a, b, return )
#define ASSERT_GT(a, b) PHAROS_COMPARE(std::greater<>, " > ", a, b, return )
#define ASSERT_GE(a, b) PHAROS_COMPARE(std::greater_equal<>, " >= ", a, b, return )
#define ASSERT_TRUE(a) PHAROS_CHECK(is(true, #a, a), return )
#define ASSERT_FALSE(a) PHAROS_CHECK(is(false, #a, a), return )

#define ADD_FAILURE() PHAROS_VERDICT(kFailed, "failure")
#define FAIL() return PHAROS_VERDICT(kFailed, "failure")
#define GTEST_SKIP() return PHAROS_VERDICT(kSkipped, "skipped")
