#pragma once
// CPU time, s. Unlike wall time it excludes the time in which other programs used the cores.
#include <thread>

namespace heml {

double cpu_seconds_of_thread();              ///< of the calling thread; a system call
double cpu_seconds_of(std::thread& thread);  ///< of a running thread; 0 when the system does not tell
double cpu_seconds_of_process();             ///< of all threads of the process, including ended ones

}  // namespace heml
