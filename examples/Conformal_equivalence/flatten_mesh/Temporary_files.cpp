// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/Temporary_files.h"

#if defined(__unix__) || defined(__APPLE__)

#include <array>
#include <atomic>
#include <csignal>
#include <cstddef>
#include <string>

#include <unistd.h>

namespace flattening {

namespace {

// A handler of signals may do little more than read atomic variables and call unlink(): the names are there for it, at fixed places.
constexpr std::size_t maximum_number_of_files = 16;
std::array<std::atomic<char*>, maximum_number_of_files> names{};

const std::array<int, 3> signals = { SIGINT, SIGTERM, SIGHUP };

// Removes the files, and lets the signal do what it would have done: it is handled as by default from now on (SA_RESETHAND).
extern "C" void remove_temporary_files(int signal)
{
  for(std::atomic<char*>& name : names)
    if(const char* file = name.load())
      unlink(file);
  raise(signal);
}

// Signals that are ignored, as by nohup, or handled in another way, stay so.
void handle_signals()
{
  for(int signal : signals)
  {
    struct sigaction action;
    if(sigaction(signal, nullptr, &action) != 0 || action.sa_handler != SIG_DFL)
      continue;
    action = {};
    action.sa_handler = remove_temporary_files;
    action.sa_flags = SA_RESETHAND;
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
  }
}

void stop_handling_signals()
{
  for(int signal : signals)
  {
    struct sigaction action;
    if(sigaction(signal, nullptr, &action) == 0 && action.sa_handler == remove_temporary_files)
      std::signal(signal, SIG_DFL);
  }
}

} // namespace

void remove_if_interrupted(const std::string& file)
{
  char* copy = new char[file.size() + 1];
  copy[file.copy(copy, file.size())] = '\0';
  handle_signals();
  for(std::atomic<char*>& name : names)
  {
    char* none = nullptr;
    if(name.compare_exchange_strong(none, copy))
      return;
  }
  delete[] copy; // there are more files than ever: this one may be left behind
}

void forget_temporary_file(const std::string& file)
{
  bool is_last = true;
  for(std::atomic<char*>& name : names)
  {
    char* found = name.load();
    if(found != nullptr && file == found)
    {
      name.store(nullptr);
      delete[] found;
    }
    else
      is_last = is_last && found == nullptr;
  }
  if(is_last)
    stop_handling_signals();
}

} // namespace flattening

#else

namespace flattening {

void remove_if_interrupted(const std::string&) {}
void forget_temporary_file(const std::string&) {}

} // namespace flattening

#endif
