#!/usr/bin/env python3
"""mutants.py PROBLEMS.txt FOLDER COUNT OUT.txt OUT_FOLDER - writes COUNT mutants of the FREE certificates of a problem file, and
COUNT of those of HIT and NEAR, and of INSIDE: bits flipped behind the header, or anywhere, the end cut off or lengthened, a stretch of bytes swapped for another's.
OUT.txt must lie in the folder of PROBLEMS.txt, which its meshes are relative to."""
import os
import random
import sys


def main():
  problems, folder, count, out, out_folder = sys.argv[1:6]
  rng = random.Random(1)
  head, blocks = [], []
  for line in open(problems):
    words = line.split()
    if words and words[0] == 'problem':
      blocks.append((words, []))
    elif words and words[0] != 'mesh' and blocks:
      blocks[-1][1].append(line)
    else:
      head.append(line)
  free, meetings, insides = [], [], []
  for words, poses in blocks:
    path = '%s/%s.cert' % (folder, words[1])
    cert = open(path, 'rb').read() if os.path.exists(path) else b''
    if not cert:  # not every answer has one
      continue
    (free if cert[0] == 4 else insides if cert[0] == 7 else meetings).append((words, poses, cert))
  os.makedirs(out_folder, exist_ok=True)
  with open(out, 'w') as text:
    text.write(''.join(head))
    for k, kin in [(k, kin) for kin in (free, meetings, insides) if kin for k in range(int(count))]:
      words, poses, cert = kin[k % len(kin)]
      bits, kind = bytearray(cert), rng.randrange(10)
      if kind < 3:  # flips near the end, where rays are
        for _ in range(1 + kind):
          bit = rng.randrange(max(0, 8 * len(bits) - 48), 8 * len(bits))
          bits[bit // 8] ^= 0x80 >> bit % 8
      elif kind < 6:  # mostly behind the header, of which a digest would tell
        for _ in range(1 + kind % 3):
          bit = rng.randrange(0 if kind == 5 else 40, 8 * len(bits)) if len(bits) > 5 else rng.randrange(8 * len(bits))
          bits[bit // 8] ^= 0x80 >> bit % 8
      elif kind < 8:
        del bits[rng.randrange(len(bits)):]
      elif kind < 9:
        bits += bytes(rng.randrange(256) for _ in range(rng.randrange(1, 4)))
      else:
        other = rng.choice(kin)[2]
        at = rng.randrange(min(5, len(bits)), len(bits) + 1)
        bits[at:] = other[at:]
      name = '%s%d' % ('m' if kin is free else 'i' if kin is insides else 'n', k)
      open('%s/%s.cert' % (out_folder, name), 'wb').write(bytes(bits))
      text.write(' '.join(['problem', name] + words[2:]) + '\n' + ''.join(poses))


main()
