// SPDX-License-Identifier: GPL-3.0-or-later
// Crafted HDF5 files: links, storage elsewhere, filters, chunks, cycles, and extents that are not
// there.
#include "hostile_files.hpp"

#include <hdf5.h>

#include <functional>
#include <stdexcept>

namespace hostile {

const std::string secret = "s3cret: a text of sixty-four bytes that is none of your business";

namespace {

hid_t good(hid_t id) {
  if (id < 0) throw std::runtime_error("HDF5 would not make a hostile file");
  return id;
}

/// A file of that name, filled and closed with all that belongs to it.
void make(const std::filesystem::path& file, const std::function<void(hid_t)>& fill) {
  const hid_t access = good(H5Pcreate(H5P_FILE_ACCESS));
  good(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG));
  const hid_t id = good(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access));
  fill(id);
  good(H5Fclose(id));
  H5Pclose(access);
}

void number(hid_t object, const char* name, double value) {
  const hid_t space = good(H5Screate(H5S_SCALAR));
  const hid_t attribute =
      good(H5Acreate2(object, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT));
  good(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value));
  H5Aclose(attribute);
  H5Sclose(space);
}

/// A surface of n² points and 1 µm, unwritten, so that its values are wherever the properties say.
hid_t surface(hid_t place, const char* name, hsize_t n, hid_t properties, hsize_t most = 0) {
  const hsize_t extents[] = {n, n}, limits[] = {most, most};
  const hid_t space = good(H5Screate_simple(2, extents, most > 0 ? limits : nullptr));
  const hid_t dataset =
      good(H5Dcreate2(place, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT));
  number(dataset, "size_x", 1e-6);
  number(dataset, "size_y", 1e-6);
  H5Sclose(space);
  return dataset;
}

void fill(hid_t dataset, std::size_t count) {
  std::vector<double> heights(count);
  for (std::size_t i = 0; i < count; ++i) heights[i] = 1e-9 * static_cast<double>(i * i % 17);
  good(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, heights.data()));
}

hid_t chunked(hsize_t chunk) {
  const hid_t properties = good(H5Pcreate(H5P_DATASET_CREATE));
  const hsize_t extents[] = {chunk, chunk};
  good(H5Pset_chunk(properties, 2, extents));
  return properties;
}

hid_t group(hid_t place, const std::string& name) {
  return good(H5Gcreate2(place, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
}

/// A surface in external files of that name.
void external(hid_t file, const std::string& elsewhere) {
  const hid_t properties = good(H5Pcreate(H5P_DATASET_CREATE));
  good(H5Pset_external(properties, elsewhere.c_str(), 0, H5F_UNLIMITED));
  surface(file, "heights", 2, properties);
}

hid_t follow_nothing(const char*, hid_t, const void*, std::size_t, hid_t, hid_t) { return -1; }

}  // namespace

std::vector<File> write_hdf5_files(const std::filesystem::path& folder) {
  std::vector<File> files;
  const auto add = [&](const std::string& name, const std::string& expected,
                       const std::function<void(hid_t)>& content) {
    make(folder / name, content);
    files.push_back({name, expected.empty(), expected});
  };

  make(folder / "other.hdf5",
       [](hid_t file) { fill(surface(file, "heights", 4, H5P_DEFAULT), 16); });

  add("external-storage.h5", "external files",
      [&](hid_t file) { external(file, (folder / "secret.txt").string()); });
  add("external-storage-relative.h5", "external files",
      [&](hid_t file) { external(file, "secret.txt"); });
  add("external-pipe.h5", "external files",
      [&](hid_t file) { external(file, (folder / "pipe").string()); });
  add("external-zero.h5", "external files", [&](hid_t file) { external(file, "/dev/zero"); });
  add("external-link.h5", "external link", [&](hid_t file) {
    good(H5Lcreate_external((folder / "other.hdf5").c_str(), "/heights", file, "heights",
                            H5P_DEFAULT, H5P_DEFAULT));
  });
  add("external-link-unnamed.h5", "external link", [&](hid_t file) {
    good(H5Lcreate_external("other.hdf5", "/heights", file, "map", H5P_DEFAULT, H5P_DEFAULT));
  });
  add("symbolic-link.h5", "symbolic link", [](hid_t file) {
    fill(surface(file, "a", 4, H5P_DEFAULT), 16);
    good(H5Lcreate_soft("/a", file, "heights", H5P_DEFAULT, H5P_DEFAULT));
  });
  add("symbolic-cycle.h5", "symbolic link", [](hid_t file) {
    good(H5Lcreate_soft("/heights", file, "heights", H5P_DEFAULT, H5P_DEFAULT));
  });
  add("user-link.h5", "link of an unknown kind", [](hid_t file) {
    H5L_class_t kind{};
    kind.version = H5L_LINK_CLASS_T_VERS;
    kind.id = static_cast<H5L_type_t>(H5L_TYPE_UD_MIN + 100);
    kind.trav_func = follow_nothing;
    good(H5Lregister(&kind));
    good(H5Lcreate_ud(file, "heights", kind.id, secret.data(), secret.size(), H5P_DEFAULT,
                      H5P_DEFAULT));
    good(H5Lunregister(kind.id));
  });
  add("virtual.h5", "virtual dataset", [&](hid_t file) {
    const hid_t properties = good(H5Pcreate(H5P_DATASET_CREATE));
    const hsize_t extents[] = {4, 4};
    const hid_t space = good(H5Screate_simple(2, extents, nullptr));
    good(H5Pset_virtual(properties, space, (folder / "other.hdf5").c_str(), "/heights", space));
    surface(file, "heights", 4, properties);
  });
  add("virtual-pipe.h5", "virtual dataset", [&](hid_t file) {
    const hid_t properties = good(H5Pcreate(H5P_DATASET_CREATE));
    const hsize_t extents[] = {4, 4};
    const hid_t space = good(H5Screate_simple(2, extents, nullptr));
    good(H5Pset_virtual(properties, space, (folder / "pipe").c_str(), "/heights", space));
    surface(file, "heights", 4, properties);
  });
  add("chunk-20000-three-times.h5", "one filter twice", [](hid_t file) {
    const hid_t properties = chunked(20000);
    for (int i = 0; i < 3; ++i) good(H5Pset_deflate(properties, 9));
    surface(file, "heights", 2, properties, 20000);
  });
  add("chunk-1500.h5", "chunks larger than itself", [](hid_t file) {
    const hid_t properties = chunked(1500);
    good(H5Pset_deflate(properties, 9));
    fill(surface(file, "heights", 2, properties, 1500), 4);
  });
  add("deflate-twice.h5", "one filter twice", [](hid_t file) {
    const hid_t properties = chunked(16);
    good(H5Pset_deflate(properties, 9));
    good(H5Pset_deflate(properties, 9));
    fill(surface(file, "heights", 16, properties), 256);
  });
  add("filter-nbit.h5", "filter 5", [](hid_t file) {
    const hid_t properties = chunked(16);
    good(H5Pset_nbit(properties));
    fill(surface(file, "heights", 16, properties), 256);
  });
  add("packed.h5", "", [](hid_t file) {
    const hid_t properties = chunked(7);
    good(H5Pset_shuffle(properties));
    good(H5Pset_deflate(properties, 6));
    good(H5Pset_fletcher32(properties));
    fill(surface(file, "heights", 16, properties), 256);
  });
  add("unwritten.h5", "larger than its data in the file", [](hid_t file) {
    const hid_t properties = chunked(1 << 10);
    surface(file, "heights", hsize_t{1} << 20, properties);
  });
  add("overflow.h5", "larger than any memory", [](hid_t file) {
    const hid_t properties = chunked(1 << 10);
    surface(file, "heights", hsize_t{1} << 31, properties);
  });
  add("flat.h5", "too many for a file of", [](hid_t file) {
    // One chunk of zeros stands for all of a surface of 512 MB: no deflate stream could be shorter,
    // as far as the sum goes.
    const hid_t properties = chunked(512);
    good(H5Pset_deflate(properties, 9));
    const hid_t dataset = surface(file, "heights", 8192, properties);
    const hsize_t start[] = {0, 0}, count[] = {512, 8192};
    const hid_t place = good(H5Dget_space(dataset));
    const hid_t memory = good(H5Screate_simple(2, count, nullptr));
    std::vector<double> noise(512 * 8192);
    unsigned state = 1;
    for (std::size_t i = 0; i < noise.size(); i += 16)
      noise[i] = static_cast<double>(state = state * 1664525U + 1013904223U);
    good(H5Sselect_hyperslab(place, H5S_SELECT_SET, start, nullptr, count, nullptr));
    good(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, memory, place, H5P_DEFAULT, noise.data()));
  });
  add("cycle.h5", "", [](hid_t file) {
    fill(surface(file, "heights", 16, H5P_DEFAULT), 256);
    const hid_t inner = group(file, "inner");
    good(H5Lcreate_hard(file, "/", inner, "up", H5P_DEFAULT, H5P_DEFAULT));
    good(H5Lcreate_hard(file, "inner", inner, "self", H5P_DEFAULT, H5P_DEFAULT));
  });
  add("many-ways.h5", "", [](hid_t file) {
    // 2^40 paths lead to the last of these groups.
    fill(surface(file, "heights", 16, H5P_DEFAULT), 256);
    hid_t place = file;
    for (int i = 0; i < 40; ++i) {
      const hid_t next = group(place, "a");
      good(H5Lcreate_hard(place, "a", place, "b", H5P_DEFAULT, H5P_DEFAULT));
      place = next;
    }
  });
  add("deep.h5", "", [](hid_t file) {
    fill(surface(file, "heights", 16, H5P_DEFAULT), 256);
    hid_t place = file;
    for (int i = 0; i < 4000; ++i) {
      const hid_t next = group(place, "a");
      if (place != file) H5Gclose(place);
      place = next;
    }
  });
  add("one-attribute-many-links.h5", "more groups, links and attributes", [](hid_t file) {
    // 60 kB by 20,000 names: 1.2 GB of attributes in a file of 1 MB.
    const hid_t dataset = surface(file, "heights", 4, H5P_DEFAULT);
    fill(dataset, 16);
    const hid_t type = good(H5Tcopy(H5T_C_S1));
    good(H5Tset_size(type, 60000));
    const hid_t space = good(H5Screate(H5S_SCALAR));
    const hid_t attribute =
        good(H5Acreate2(dataset, "note", type, space, H5P_DEFAULT, H5P_DEFAULT));
    const std::string text(60000, 'x');
    good(H5Awrite(attribute, type, text.data()));
    for (int i = 0; i < 20000; ++i)
      good(H5Lcreate_hard(file, "heights", file, ("name" + std::to_string(i)).c_str(), H5P_DEFAULT,
                          H5P_DEFAULT));
  });
  add("type-as-heights.h5", "neither group nor dataset", [](hid_t file) {
    const hid_t type = good(H5Tcopy(H5T_IEEE_F64LE));
    good(H5Tcommit2(file, "heights", type, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  });
  add("group-as-heights.h5", "a group instead of a dataset",
      [](hid_t file) { group(file, "heights"); });
  return files;
}

namespace {

void change(const std::filesystem::path& file, const std::function<void(hid_t)>& edit) {
  const hid_t id = good(H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT));
  edit(id);
  good(H5Fclose(id));
}

}  // namespace

void set_text(const std::filesystem::path& file, const std::string& object,
              const std::string& attribute, const std::string& text) {
  change(file, [&](hid_t id) {
    const hid_t owner = good(H5Oopen(id, object.c_str(), H5P_DEFAULT));
    if (H5Aexists(owner, attribute.c_str()) > 0) good(H5Adelete(owner, attribute.c_str()));
    const hid_t type = good(H5Tcopy(H5T_C_S1));
    good(H5Tset_size(type, text.size() + 1));
    const hid_t space = good(H5Screate(H5S_SCALAR));
    const hid_t made =
        good(H5Acreate2(owner, attribute.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT));
    good(H5Awrite(made, type, text.c_str()));
    H5Aclose(made);
    H5Sclose(space);
    H5Tclose(type);
    H5Oclose(owner);
  });
}

void set_numbers(const std::filesystem::path& file, const std::string& dataset,
                 const std::vector<double>& values, std::size_t rows) {
  change(file, [&](hid_t id) {
    if (H5Lexists(id, dataset.c_str(), H5P_DEFAULT) > 0)
      good(H5Ldelete(id, dataset.c_str(), H5P_DEFAULT));
    const hsize_t extents[] = {rows > 0 ? rows : values.size(),
                               rows > 0 ? values.size() / rows : 1};
    const hid_t space = good(H5Screate_simple(rows > 0 ? 2 : 1, extents, nullptr));
    const hid_t made = good(H5Dcreate2(id, dataset.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT,
                                       H5P_DEFAULT, H5P_DEFAULT));
    if (!values.empty())
      good(H5Dwrite(made, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
    H5Dclose(made);
    H5Sclose(space);
  });
}

void remove(const std::filesystem::path& file, const std::string& name) {
  change(file, [&](hid_t id) { good(H5Ldelete(id, name.c_str(), H5P_DEFAULT)); });
}

}  // namespace hostile
