// LeakSanitizer's exceptions: libpng leaves OpenImageIO's reader by longjmp at a damaged file, past
// the destructor of an error text.
extern "C" const char* __lsan_default_suppressions();  // NOLINT: the sanitizer's name
extern "C" const char* __lsan_default_suppressions() { return "leak:libOpenImageIO"; }
