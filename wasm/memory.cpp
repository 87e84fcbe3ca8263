// The memory that callers pass arguments in: in every module.
#include <cstdlib>

#include "c_api.h"

void* pm_alloc(uint32_t bytes) { return std::malloc(bytes); }
void pm_free(void* memory) { std::free(memory); }
