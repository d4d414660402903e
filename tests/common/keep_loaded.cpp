// With AddressSanitizer: drivers and layers stay loaded to the end, so that a leak of theirs is reported under their
// name and cmake/leaks_of_others.txt can tell it from one of ours.
extern "C" int dlclose(void*) noexcept { return 0; }
