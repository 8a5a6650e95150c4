#include "output.h"

#include <string.h>

#include "run.h"

static void write_values(FILE *file, const char *name, const double *values, size_t count, int components) {
  fprintf(file, "<DataArray type=\"Float64\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"ascii\">\n", name,
          components);
  for (size_t i = 0; i < count; ++i) {
    for (int k = 0; k < components; ++k) {
      fprintf(file, "%.17g%c", values[i * (size_t)components + (size_t)k], k + 1 == components ? '\n' : ' ');
    }
  }
  fputs("</DataArray>\n", file);
}

static void write_cells(FILE *file, const uint32_t *cells, size_t size, size_t count) {
  fputs("<Cells>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n", file);
  for (size_t i = 0; i < size * count; ++i) {
    fprintf(file, "%lu%c", cells == NULL ? (unsigned long)i : (unsigned long)cells[i], (i + 1) % size ? ' ' : '\n');
  }
  fputs("</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n", file);
  for (size_t i = 1; i <= count; ++i) {
    fprintf(file, "%lu\n", (unsigned long)(size * i));
  }
  fputs("</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n", file);
  for (size_t i = 0; i < count; ++i) {
    fputs(size == 1 ? "1\n" : size == 2 ? "3\n" : "5\n", file);
  }
  fputs("</DataArray>\n</Cells>\n", file);
}

FILE *output_open(const char *directory, const char *name) {
  char path[1024];
  if (strlen(directory) + strlen(name) + 2 > sizeof path) {
    fprintf(stderr, "demo: output folder '%.60s...' has too long a name\n", directory);
    return NULL;
  }
  strcpy(path, directory);
  strcat(path, "/");
  strcat(path, name);
  FILE *file = fopen(path, "wb");
  if (file == NULL) {
    fprintf(stderr, "demo: cannot write '%s'\n", path);
  }
  return file;
}

int vtu_write(const char *directory, const char *name, const double *points, size_t point_count, const uint32_t *cells,
              size_t cell_points, size_t cell_count, const vtu_field *fields, size_t field_count) {
  FILE *file = output_open(directory, name);
  if (file == NULL) {
    return 2;
  }
  if (cell_points == 0) {
    cells = NULL;
    cell_points = 1;
    cell_count = point_count;
  }
  fprintf(
      file,
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"%lu\" NumberOfCells=\"%lu\">\n<Points>\n",
      (unsigned long)point_count, (unsigned long)cell_count);
  write_values(file, "Points", points, point_count, 3);
  fputs("</Points>\n", file);
  write_cells(file, cells, cell_points, cell_count);
  fputs("<PointData>\n", file);
  for (size_t i = 0; i < field_count; ++i) {
    write_values(file, fields[i].name, fields[i].values, point_count, fields[i].components);
  }
  fputs("</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n", file);
  int failed = ferror(file);
  failed = fclose(file) != 0 || failed;
  if (failed) {
    fprintf(stderr, "demo: writing '%s' failed: is the disk full?\n", name);
  }
  return failed ? 2 : 0;
}

int write_trace(const dsw_environment *environment, const char *out, const char *name, int with_boundary) {
  dsw_trace *trace = NULL;
  dsw_trace_data data;
  data.struct_size = sizeof data;
  require(dsw_trace_create(NULL, &trace), "creating a trace", kFailed);
  require(dsw_trace_add_impassable(trace, environment, with_boundary, 0), "tracing the wall", kFailed);
  require(dsw_trace_get_data(trace, &data), "reading a trace", kFailed);
  int code = vtu_write(out, name, data.points, data.point_count, data.triangles, 3, data.triangle_count, NULL, 0);
  require(dsw_trace_destroy(trace), "destroying a trace", kFailed);
  return code;
}

vtu_field field(const char *name, const double *values, int components) {
  vtu_field f;
  f.name = name;
  f.values = values;
  f.components = components;
  return f;
}

int write_touches(const char *out, const char *name, const double *points, const double *normals, size_t count) {
  vtu_field normal = field("normal", normals, 3);
  return vtu_write(out, name, points, count, NULL, 0, 0, &normal, 1);
}
