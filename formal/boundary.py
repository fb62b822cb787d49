#!/usr/bin/env python3
"""boundary.py FOLDER - HIT and NEAR where they begin and end to be true: at times a few parts in 4,294,967,295 of the motion from there.
What is true is computed here, to 50 digits. Neither program may accept what is not, nor verify what the referee refuses, which asks for
no margin; it has to accept what is true a million such parts from there. Slow motions and turns, of little triangles and large ones, near the
origin and 10 km from it. FOLDER is written; build/verify and build/referee are run. Ends with 1 if one of them errs."""
import math
import os
import random
import struct
import subprocess
import sys
from decimal import Decimal, getcontext

getcontext().prec = 50
rng = random.Random(1)
TIMES = 4294967295
OFF = [0, 1, 2, 4, 8, 20, 60, 200, 1000, 10000, 1000000]  # of the times, from the boundary


def single(x):
  return struct.unpack('<f', struct.pack('<f', x))[0]


def word(x):
  return struct.unpack('<I', struct.pack('<f', x))[0]


# ---- digests: examples/verify/nsvcd_verify_scene.h

def mixed(seed, word_):
  seed = (seed ^ word_) * 0x9e3779b1 & 0xffffffff
  return seed ^ seed >> 15


def hashed(seed, words):
  for word_ in words:
    seed = mixed(seed, word_)
  return seed


# ---- motions

def series(x, first):
  """The sum of x^k / k! for k = first, first + 2, ..., with alternating signs: cosine and sine."""
  term, total, k = x if first else Decimal(1), Decimal(0), first
  while abs(term) > Decimal('1e-55'):
    total += term
    term *= -x * x / ((k + 1) * (k + 2))
    k += 2
  return total


def dot(u, v):
  return sum(x * y for x, y in zip(u, v))


def cross(u, v):
  return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


def plus(u, v, times=1):
  return [x + times * y for x, y in zip(u, v)]


def pose_of(at, q):
  """Floats, as a file's numbers are read."""
  length = math.sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
  return [single(x) for x in at] + [single(x / length) for x in q]


class Motion:
  def __init__(self, scale, poses):
    self.scale, self.poses = scale, poses
    (self.p, self.q), (self.p1, self.q1) = [([Decimal(x) for x in pose[:3]], [Decimal(x) for x in pose[3:]]) for pose in (poses[0], poses[-1])]
    for q in (self.q, self.q1):
      length = dot(q, q).sqrt()
      q[:] = [x / length for x in q]
    if dot(self.q, self.q1) < 0:
      self.q1 = [-x for x in self.q1]
    off, along = plus(self.q1, self.q, -1), plus(self.q1, self.q)
    sine = dot(off, off).sqrt() / (dot(off, off) + dot(along, along)).sqrt()  # of a quarter of the turn
    quarter = Decimal(math.asin(float(sine)))
    for _ in range(4):
      quarter -= (series(quarter, 1) - sine) / series(quarter, 0)
    self.half = 2 * quarter

  def place(self, k, x):
    u = Decimal(k) / TIMES
    q = self.q
    if self.half:
      s, s1 = series((1 - u) * self.half, 1), series(u * self.half, 1)
      q = [s * a + s1 * b for a, b in zip(self.q, self.q1)]
    x = [Decimal(self.scale) * Decimal(c) for c in x]
    around = cross(q[:3], x)  # the rotation is x + 2 (w v cross x + v cross (v cross x)) / q.q
    moved = plus([q[3] * c for c in around], cross(q[:3], around))
    return plus(plus(x, moved, 2 / dot(q, q)), plus([(1 - u) * c for c in self.p], [u * c for c in self.p1]))

  def digest(self):
    return hashed(hashed(len(self.poses), [word(x) for pose in self.poses for x in pose]), [word(self.scale)])


# ---- what is true

def det(u, v, w):
  return dot(u, cross(v, w))


def pierces(p, q, t):
  d, (u, v, w) = plus(q, p, -1), [plus(c, p, -1) for c in t]
  sides = [det(d, u, v), det(d, v, w), det(d, w, u)]
  sign = 1 if sides[0] > 0 else -1
  ends = det(u, v, w), det(*[plus(c, q, -1) for c in t])
  return all(sign * x > 0 for x in sides) and sign * ends[0] > 0 and sign * ends[1] < 0


def blend(weights, corners):
  return [dot(weights, axis) for axis in zip(*corners)]


class Scene:
  """Bodies that, at about 0.4 of the time, come to be as near as the clearance, or pierced."""

  def __init__(self, meshes, clearance, hit):
    self.hit, self.tris = hit, [rng.randrange(len(m)) for m in meshes]
    scale = [single(rng.choice([1, 1, 0.05, 30]) * rng.uniform(0.5, 1)) for _ in range(2)]
    far, slow = rng.choice([0, 0, 1, 100, 10000]), 10 ** -rng.uniform(0, 3)
    turns = rng.random() < 0.7
    poses = []
    for n in range(2):
      q = [rng.gauss(0, 1) for _ in range(4)]
      length = math.sqrt(dot(q, q))
      first = pose_of([rng.uniform(-1, 1) + far for _ in range(3)], q)
      # a turn too small to be one in floats is none
      last = pose_of(plus(first[:3], [rng.gauss(0, slow) for _ in range(3)]), [x + turns * slow * length * rng.gauss(0, 0.5) for x in q])
      poses.append([first] if n and rng.random() < 0.5 else [first, last if turns else last[:3] + first[3:]])
    if hit:
      self.whose, self.edge = rng.randrange(2), rng.randrange(3)
      b = rng.uniform(0.2, 0.8)
      along, on = rng.choice([(0.5, [0, b, 1 - b]), (0.5, [b, 0, 1 - b]), (0.5, [b, 1 - b, 0]), (0, [0.3, 0.3, 0.4]), (1, [0.5, 0.2, 0.3])])
      ends = [0] * 3
      ends[self.edge], ends[(self.edge + 1) % 3] = 1 - along, along
      weights = [on, ends] if self.whose else [ends, on]
    else:
      self.shares = [rng.choice([0, 65535, rng.randrange(65536), rng.randrange(65536)]) for _ in range(4)]
      weights = self.weights()
    # b is put where its point is the one of a, or a clearance off
    self.motions = [Motion(s, p) for s, p in zip(scale, poses)]
    at = [blend([Decimal(w) for w in weights[n]], [self.motions[n].place(int(0.4 * TIMES), x) for x in meshes[n][self.tris[n]]]) for n in range(2)]
    way = [rng.gauss(0, 1) for _ in range(3)]
    shift = plus([float(x) for x in plus(at[0], at[1], -1)], way, 0 if hit else clearance / math.sqrt(dot(way, way)))
    moved = [[single(x) for x in plus(pose[:3], shift)] + pose[3:] for pose in poses[1]]
    self.motions[1] = Motion(scale[1], moved)
    self.corners = [meshes[n][self.tris[n]] for n in range(2)]
    self.clearance = clearance

  def weights(self):
    s = [Decimal(x) / 65535 for x in self.shares]
    return [[1 - s[k], s[k] * (1 - s[k + 1]), s[k] * s[k + 1]] for k in (0, 2)]

  def is_true(self, k):
    a, b = [[m.place(k, x) for x in corners] for m, corners in zip(self.motions, self.corners)]
    if self.hit:
      e, t = (b, a) if self.whose else (a, b)
      return pierces(e[self.edge], e[(self.edge + 1) % 3], t)
    way = plus(blend(self.weights()[0], a), blend(self.weights()[1], b), -1)
    return dot(way, way) < Decimal(self.clearance) ** 2

  def boundary(self):
    """The last of the times before it changes; None: it does not, within a 60th of all, or a pose is not read as it is written."""
    if any(pose_of(pose[:3], pose[3:]) != pose for m in self.motions for pose in m.poses):
      return None
    low, high = [int(0.4 * TIMES) + off for off in (-(1 << 26), 1 << 26)]
    first = self.is_true(low)
    if first == self.is_true(high):
      return None
    while high > low + 1:
      k = (low + high) // 2
      low, high = (k, high) if self.is_true(k) == first else (low, k)
    return low

  def certificate(self, k, digests):
    ma, mb = [m.digest() for m in self.motions]
    motion = mixed((ma + 31 * mb) & 0xffffffff, word(self.clearance))
    head = bytes([5 if self.hit else 6]) + bytes((d ^ d >> 16 ^ (d ^ d >> 16) >> 8) & 255 for d in digests)
    out = head + struct.pack('>H', (motion ^ motion >> 16) & 0xffff) + struct.pack('>3I', k, *self.tris)
    return out + (bytes([self.whose << 7 | self.edge << 5]) if self.hit else struct.pack('>4H', *self.shares))

  def lines(self, name):
    words = [[' '.join('%.17g' % x for x in pose) for pose in m.poses] for m in self.motions]
    a, b = ['%.9g' % m.scale for m in self.motions]
    return ['problem %s a %s b %s %s -1 nan %d %d' % (name, a, b, words[1][0], len(words[0]), len(words[1]))] + words[0] + words[1]


def main():
  counts, bad = {}, 0
  for clearance in (single(0.02), single(3)):
    folder = '%s/%g' % (sys.argv[1], clearance)
    os.makedirs(folder, exist_ok=True)
    meshes = [[[[single(rng.uniform(-1, 1)) for _ in range(3)] for _ in range(3)] for _ in range(12)] for _ in range(2)]
    text, truth, digests = ['nsvcd-problems 1'], {}, []
    for name, mesh in zip('ab', meshes):
      numbers = [x for t in mesh for c in t for x in c]
      digests.append(hashed(hashed(3 * len(mesh), [word(x) for x in numbers]), range(3 * len(mesh))))
      with open('%s/%s.obj' % (folder, name), 'w') as out:
        out.writelines('v %.9g %.9g %.9g\n' % tuple(c) for t in mesh for c in t)
        out.writelines('f %d %d %d\n' % (k, k + 1, k + 2) for k in range(1, 3 * len(mesh), 3))
      text.append('mesh %s %s.obj' % (name, name))
    for n in range(30):
      scene, k = None, None
      while k is None:
        scene = Scene(meshes, clearance, n % 2)
        k = scene.boundary()
      for off in [-x for x in OFF] + [1 + x for x in OFF]:
        name = '%s%d_%d' % ('hit' if scene.hit else 'near', n, off)
        truth[name] = scene.is_true(k + off)
        open('%s/%s.cert' % (folder, name), 'wb').write(scene.certificate(k + off, digests))
        text += scene.lines(name)
    path = '%s/problems.txt' % folder
    open(path, 'w').write('\n'.join(text) + '\n')
    said = []
    for program in ('build/verify', 'build/referee'):
      lines = subprocess.run([program, path, folder, '--clearance', '%.9g' % clearance], stdout=subprocess.PIPE, universal_newlines=True).stdout
      said.append({line.split('\t')[0]: line.split('\t')[1:3] for line in lines.splitlines()})
    for name, true in truth.items():
      verify, referee = [s.get(name, ['missing', '']) for s in said]
      fits = verify[1] == referee[1] if verify[0] == referee[0] else (verify[0], referee[0]) == ('refused', 'accepted')
      about = all(v[0] == 'accepted' or 'an edge does not' in v[1] or 'two points' in v[1] for v in (verify, referee))
      far = max(OFF) <= abs(int(name.split('_')[1]))
      if not fits or not about or (referee[0] == 'accepted' and not true) or (referee[0] == 'refused' and true and far):
        print('boundary: %s of %s, %s: verify %s, the referee %s' % (name, path, true, verify, referee))
        bad += 1
      key = (true, verify[0], referee[0])
      counts[key] = counts.get(key, 0) + 1
  both, alone, neither = [counts.get((True, v, r), 0) for v, r in (('accepted', 'accepted'), ('refused', 'accepted'), ('refused', 'refused'))]
  print('boundary: %d certificates, %d true: both accept %d, the referee alone %d, both refuse %d' % (sum(counts.values()), both + alone + neither, both, alone, neither))
  sys.exit(bad > 0 or not both or not alone)


main()
