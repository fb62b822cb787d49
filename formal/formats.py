#!/usr/bin/env python3
"""formats.py PROBLEMS.txt OUT - writes a problem file anew whose meshes are OBJ of triangles, with each of them in three other ways:
OUT.binary.txt as binary STL, OUT.text.txt as STL in words, OUT.faces.txt as OBJ of faces of up to 12 corners, bent ones too, and with
all else that a line may hold; and a problem of the least and the greatest scale. Prints the names of the three. The faces are not those
of the file: their triangles share its edges."""
import os
import random
import struct
import sys

rng = random.Random(1)


def read_obj(path):
  vertices, faces = [], []
  for line in open(path):
    words = line.split('#')[0].split()
    if words and words[0] == 'v':
      vertices.append([float(w) for w in words[1:4]])
    elif words and words[0] == 'f':
      faces.append([int(w.split('/')[0]) - 1 for w in words[1:]])
  return vertices, faces


def binary(vertices, faces):
  """Begins as one in words does. Zeros of either sign are one place."""
  def number(x):
    return struct.pack('<f', -0.0 if x == 0 and rng.random() < 0.5 else x)
  out = [b'solid'.ljust(80), struct.pack('<I', len(faces))]
  for face in faces:
    out += [bytes(12)] + [number(x) for v in face for x in vertices[v]] + [b'\1\2']
  return b''.join(out)


def text(vertices, faces):
  out = [' \tSOLID of words # vertex 1 2']
  for face in faces:
    out += ['facet normal 0 0 1', 'outer loop']
    out += ['\t%s %s' % (rng.choice(['vertex', 'Vertex', 'VERTEX']), ' '.join(repr(x) for x in vertices[v])) for v in face]
    out += ['endloop', 'endfacet']
  return rng.choice(['\n', '\r\n']).join(out + ['endsolid']).encode()


def merged(faces):
  """Faces of triangles that share edges: each takes up neighbours while their far corner is new to it."""
  beside = {}
  for k, face in enumerate(faces):
    for i in range(3):
      beside.setdefault((face[i], face[(i + 1) % 3]), []).append(k)
  used, out = set(), []
  for k, face in enumerate(faces):
    if k in used:
      continue
    used.add(k)
    loop, most, i = list(face), rng.choice([3, 4, 4, 5, 12]), 0
    while i < len(loop) and len(loop) < most:
      edge = (loop[(i + 1) % len(loop)], loop[i])
      other = next((n for n in beside.get(edge, []) if n not in used), None)
      far = [v for v in faces[other] if v not in edge] if other is not None else []
      if len(far) == 1 and far[0] not in loop:
        loop.insert(i + 1, far[0])
        used.add(other)
      i += rng.choice([0, 1]) if far else 1
    out.append(loop)
  return out


def obj(vertices, faces):
  def corner(v):
    return rng.choice(['%d', '%d', '%d/7', '%d//', '%d/1/2']) % (v + 1) if rng.random() < 0.8 else str(v - len(vertices))
  out = ['v %s%s' % (' '.join(repr(x) for x in v), rng.choice(['', '', '\t1', ' 0.5 nan 1 # c', ' # \\'])) for v in vertices]
  out += ['o a', 'vn 0 0 1', 's off']
  ends = rng.choice(['\n', '\r\n', '\r'])
  for face in merged(faces):
    out.append('f ' + ''.join(corner(v) + rng.choice([' ', ' ', '\t', ' \\' + ends, '\\' + ends + '\\' + ends + ' ']) for v in face))
  return b'\xef\xbb\xbf' + ends.join(out + ['']).encode()


def main():
  problems, base = sys.argv[1:3]
  for kind, write, ending in (('binary', binary, 'stl'), ('text', text, 'STL'), ('faces', obj, 'obj')):
    os.makedirs('%s.%s' % (base, kind), exist_ok=True)
    name = ''
    with open('%s.%s.txt' % (base, kind), 'w') as out:
      for line in open(problems):
        words = line.split()
        if words and words[0] == 'mesh':
          path = '%s.%s/%s.%s' % (base, kind, words[1], ending)
          open(path, 'wb').write(write(*read_obj(os.path.join(os.path.dirname(problems), words[2]))))
          line = 'mesh %s %s\n' % (words[1], os.path.relpath(path, os.path.dirname(base)))
        out.write(line)
        name = words[1] if words and words[0] == 'mesh' else name
      out.write('problem scales %s 1e-6 %s 1e6 0 0 0 0 0 0 1 -1 nan 1\n1e6 0 0 0 0 0 1\n' % (name, name))
    print('%s.%s.txt' % (base, kind))


main()
