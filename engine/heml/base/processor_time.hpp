#pragma once
// Processor time, which unlike wall time leaves out what other programs had the cores for.
#include <thread>

namespace heml {

double processor_seconds_of_thread();              ///< that the calling thread has had; a system call
double processor_seconds_of(std::thread& thread);  ///< that a running thread has had
double processor_seconds_of_process();             ///< that all threads of the process have had, those that ended too

}  // namespace heml
