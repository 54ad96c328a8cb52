// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Boost.Test, with or without its compiled library, for the tests of the package:
//
//   #define BOOST_TEST_MODULE test_layout
//   #include "include/boost_test.h"
//
//   BOOST_AUTO_TEST_CASE(square) { ... }
//   BOOST_AUTO_TEST_CASE(lion, * testing::needs_mesh("lion-head.off")) { ... }
//   BOOST_AUTO_TEST_CASE(many, * testing::slow()) { ... }
//
// A program that was not given a mesh it needs says so and returns 77,
// which CTest shows as "Skipped"; a failure is never hidden by that.

#ifndef CGAL_TEST_CONFORMAL_EQUIVALENCE_BOOST_TEST_H
#define CGAL_TEST_CONFORMAL_EQUIVALENCE_BOOST_TEST_H

#ifndef BOOST_TEST_MODULE
#  error "Define BOOST_TEST_MODULE before including boost_test.h"
#endif

#define BOOST_TEST_NO_MAIN

#ifdef BOOST_TEST_DYN_LINK // CMake found the library
#  include <boost/test/unit_test.hpp>
#else
#  include <boost/test/included/unit_test.hpp>
#endif

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

namespace testing {

/// the value that CTest reads as "skipped"
constexpr int skip_return_code = 77;

inline bool& something_was_skipped()
{
  static bool value = false;
  return value;
}

/// returns the path of one of CGAL's meshes, for example `mesh_path("lion-head.off")`;
/// the folder is `meshes/` in `CGAL_DATA_DIR`, of the environment or else of the build.
inline std::string mesh_path(const std::string& name)
{
  if(const char* folder = std::getenv("CGAL_DATA_DIR"))
    return std::string(folder) + "/meshes/" + name;
#ifdef CGAL_DATA_DIR
  return std::string(CGAL_DATA_DIR) + "/meshes/" + name;
#else
  return "meshes/" + name;
#endif
}

inline bool has_mesh(const std::string& name)
{
  return std::ifstream(mesh_path(name)).good();
}

/// notes that something was skipped, and why; the program will return `skip_return_code`.
inline void skip(const std::string& reason)
{
  something_was_skipped() = true;
  std::cout << "SKIPPED: " << reason << std::endl;
}

/// a decorator of a test case that is skipped, visibly, if the mesh is absent
inline boost::unit_test::decorator::precondition needs_mesh(const std::string& name)
{
  return boost::unit_test::decorator::precondition(
    [name](boost::unit_test::test_unit_id) -> boost::test_tools::assertion_result
    {
      boost::test_tools::assertion_result result(has_mesh(name));
      if(!result)
      {
        const std::string reason = mesh_path(name) + " is not there (scripts/fetch_data, CGAL_DATA_DIR)";
        skip(reason);
        result.message() << reason;
      }
      return result;
    });
}

/// whether time is short (under sanitizers): if `CONFORMAL_EQUIVALENCE_SKIP_SLOW_TESTS` is set in the environment
inline bool is_time_short() { return std::getenv("CONFORMAL_EQUIVALENCE_SKIP_SLOW_TESTS") != nullptr; }

/// how many of n cases that are alike are tried: all of them, or a fourth where time is short
inline int number_of_cases(int n) { return is_time_short() ? (n + 3) / 4 : n; }

/// the same, of cases that are listed
template <typename Case>
std::vector<Case> cases(std::vector<Case> all)
{
  all.resize(std::size_t(number_of_cases(int(all.size()))));
  return all;
}

/// whether the slow tests are to run
inline boost::test_tools::assertion_result wants_slow_tests(boost::unit_test::test_unit_id)
{
  boost::test_tools::assertion_result result(!is_time_short());
  if(!result)
    result.message() << "slow tests are not asked for";
  return result;
}

/// a decorator of a test case that is left out where time is short
inline boost::unit_test::decorator::precondition slow()
{
  return boost::unit_test::decorator::precondition(&wants_slow_tests);
}

} // namespace testing

int main(int argc, char* argv[])
{
#ifdef BOOST_TEST_ALTERNATIVE_INIT_API
  const int result = boost::unit_test::unit_test_main(&init_unit_test, argc, argv);
#elif defined(BOOST_TEST_DYN_LINK)
  const int result = boost::unit_test::unit_test_main(&init_unit_test, argc, argv);
#else
  const int result = boost::unit_test::unit_test_main(&init_unit_test_suite, argc, argv);
#endif
  return (result == 0 && testing::something_was_skipped()) ? testing::skip_return_code : result;
}

#endif // CGAL_TEST_CONFORMAL_EQUIVALENCE_BOOST_TEST_H
