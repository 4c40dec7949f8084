#include <dlfcn.h>

#include <algorithm>
#include <app/panel/system_fonts.hpp>
#include <array>
#include <fstream>
#include <string_view>

namespace heml::panel {
namespace {

/// Whether a file begins as a TrueType or OpenType font or collection.
bool is_outline_font(const std::string& path) {
  std::array<char, 4> head{};
  std::ifstream file(path, std::ios::binary);
  if (!file.read(head.data(), head.size())) return false;
  const std::string_view kind(head.data(), head.size());
  return kind == std::string_view("\0\1\0\0", 4) || kind == "OTTO" || kind == "ttcf" || kind == "true";
}

/// The part of fontconfig's interface that is used; its types are opaque here but for FcFontSet.
class Fontconfig {
 public:
  Fontconfig() : library_(dlopen("libfontconfig.so.1", RTLD_NOW | RTLD_LOCAL)) {
    if (!library_) return;
    has_all_ = load(make_pattern, "FcPatternCreate") && load(make_set, "FcCharSetCreate") &&
               load(add_letter, "FcCharSetAddChar") && load(add_set, "FcPatternAddCharSet") &&
               load(substitute, "FcConfigSubstitute") && load(substitute_rest, "FcDefaultSubstitute") &&
               load(sort, "FcFontSort") && load(get_text, "FcPatternGetString") &&
               load(get_integer, "FcPatternGetInteger") && load(get_set, "FcPatternGetCharSet") &&
               load(has_letter, "FcCharSetHasChar") && load(free_pattern, "FcPatternDestroy") &&
               load(free_set, "FcCharSetDestroy") && load(free_fonts, "FcFontSetDestroy");
  }
  bool usable() const { return has_all_; }

  struct FontSet {
    int count, room;
    void** fonts;
  };
  void* (*make_pattern)() = nullptr;
  void* (*make_set)() = nullptr;
  int (*add_letter)(void* set, unsigned letter) = nullptr;
  int (*add_set)(void* pattern, const char* object, const void* set) = nullptr;
  int (*substitute)(void* config, void* pattern, int kind) = nullptr;
  void (*substitute_rest)(void* pattern) = nullptr;
  FontSet* (*sort)(void* config, void* pattern, int trim, void** letters, int* result) = nullptr;
  int (*get_text)(const void* pattern, const char* object, int n, unsigned char** text) = nullptr;
  int (*get_integer)(const void* pattern, const char* object, int n, int* value) = nullptr;
  int (*get_set)(const void* pattern, const char* object, int n, void** set) = nullptr;
  int (*has_letter)(const void* set, unsigned letter) = nullptr;
  void (*free_pattern)(void* pattern) = nullptr;
  void (*free_set)(void* set) = nullptr;
  void (*free_fonts)(FontSet* fonts) = nullptr;

 private:
  template <class Function>
  bool load(Function& function, const char* name) {
    function = reinterpret_cast<Function>(dlsym(library_, name));
    return function != nullptr;
  }

  void* library_;  // stays open: fontconfig keeps caches
  bool has_all_ = false;
};

/// Adds a font if it has some of the missing letters, and takes those off.
void take_font(const Fontconfig& library, const void* font, std::set<unsigned>& missing, std::vector<FontFile>& files) {
  void* letters = nullptr;
  unsigned char* path = nullptr;
  int index = 0;
  if (library.get_set(font, "charset", 0, &letters) != 0 || library.get_text(font, "file", 0, &path) != 0) return;
  library.get_integer(font, "index", 0, &index);
  const std::string file = reinterpret_cast<const char*>(path);
  const auto has = [&](unsigned letter) { return library.has_letter(letters, letter) != 0; };
  if (std::none_of(missing.begin(), missing.end(), has) || !is_outline_font(file)) return;
  std::erase_if(missing, has);
  files.push_back({file, index & 0xffff});  // above: the named instance of a variable font
}

std::vector<FontFile> configured_fonts(const Fontconfig& library, std::set<unsigned> missing) {
  void *pattern = library.make_pattern(), *wanted = library.make_set();
  for (const unsigned letter : missing) library.add_letter(wanted, letter);
  library.add_set(pattern, "charset", wanted);
  library.substitute(nullptr, pattern, 0);
  library.substitute_rest(pattern);
  int result = 0;
  std::vector<FontFile> files;
  if (Fontconfig::FontSet* fonts = library.sort(nullptr, pattern, 1, nullptr, &result)) {
    for (int k = 0; k < fonts->count && !missing.empty(); ++k) take_font(library, fonts->fonts[k], missing, files);
    library.free_fonts(fonts);
  }
  library.free_set(wanted);
  library.free_pattern(pattern);
  return files;
}

std::vector<FontFile> usual_fonts() {
  std::vector<FontFile> files;
  for (const char* path :
       {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc",
        "/usr/share/fonts/google-noto-cjk/NotoSansCJK-Regular.ttc", "/usr/share/fonts/noto-cjk/NotoSansCJK-Regular.ttc",
        "/usr/share/fonts/truetype/droid/DroidSansFallbackFull.ttf", "/usr/share/fonts/truetype/wqy/wqy-microhei.ttc"})
    if (is_outline_font(path)) files.push_back({path, 0});
  return files;
}

}  // namespace

std::vector<FontFile> fonts_with(const std::set<unsigned>& letters) {
  static const Fontconfig library;
  if (letters.empty()) return {};
  return library.usable() ? configured_fonts(library, letters) : usual_fonts();
}

}  // namespace heml::panel
