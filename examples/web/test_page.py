"""Uses the pages in a headless Chromium as a person does, and holds the first one's answers against build/svcd's:

    python3 test_page.py build/web/index.html build/svcd build/web/page.png

Drags, keys, fingers, dropped and chosen files, wrong ones among them, links, the gallery, options,
numbers out of range, at the sizes of a phone, a tablet and a desk. The console must stay empty. The
gallery is opened in a headless Firefox as well, where there is one. Writes a picture of the page, and prints what a question takes there and in
build/svcd; that time is only held to be below SLOWEST. Proofs that the page saves are shown to
build/verify, which lies beside build/svcd. Of throw.html, beside the first: things come to rest, one
walks, and nothing overlaps; throw-1000.png is its picture.
"""

import base64
import functools
import http.server
import json
import math
import os
import random
import re
import shutil
import struct
import subprocess
import sys
import tarfile
import tempfile
import threading
import time
import unittest
from pathlib import Path

try:
    import websocket  # for Firefox, which Debian has no driver of
except ImportError:
    websocket = None
from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

PAGE, SVCD, PICTURE = (Path(name).resolve() for name in sys.argv[1:4])
VERIFY = SVCD.with_name("verify")
ASSETS = Path(__file__).resolve().parent.parent / "assets"
SLOWEST = 1000  # us of a question, the median; a page that does without vectors or compiler is slower
FIRST = 0.01

FIRST_ANSWER = 200  # ms from navigation to the first answer, at best of nine; beside other work
SCENES = ("mug", "stairs", "arm", "ring", "needle")
SIZES = ((390, 844), (768, 1024), (1280, 800))
CUBE_FACES = "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n"


def cube(half: float) -> str:
    corners = [(x, y, z) for z in (-half, half) for y in (-half, half) for x in (-half, half)]
    return "".join(f"v {x} {y} {z}\n" for x, y, z in corners) + CUBE_FACES


def soup(half: float) -> list:
    """The triangles of that cube."""
    lines = [line.split() for line in cube(half).splitlines()]
    corners = [tuple(float(x) for x in line[1:]) for line in lines if line[0] == "v"]
    faces = [[corners[int(v) - 1] for v in line[1:]] for line in lines if line[0] == "f"]
    return [(a, b, c) for p, q, r, t in faces for a, b, c in ((p, q, r), (p, r, t))]


def formats(half: float) -> dict:
    """That cube in each format, by the file's name."""
    triangles = soup(half)
    text = "".join("facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {x} {y} {z}\n" for x, y, z in t) +
                   "endloop\nendfacet\n" for t in triangles)
    numbers = [struct.pack("<9f", *(x for corner in t for x in corner)) for t in triangles]
    lines = [line[2:] for line in cube(half).splitlines()]
    faces = "".join("4 " + " ".join(str(int(v) - 1) for v in line.split()) + "\n" for line in lines[8:])
    ply = ("ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 6\nproperty list uchar int vertex_indices\nend_header\n" + "\n".join(lines[:8]) + "\n" + faces)
    data = b"".join(numbers)
    tree = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "buffers": [{"byteLength": len(data)}],
            "bufferViews": [{"buffer": 0, "byteLength": len(data)}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 36, "type": "VEC3",
                           "min": [-half] * 3, "max": [half] * 3}]}
    words = json.dumps(tree).encode()
    words += b" " * (-len(words) % 4)
    glb = (struct.pack("<4sII", b"glTF", 2, 28 + len(words) + len(data)) + struct.pack("<I4s", len(words), b"JSON") +
           words + struct.pack("<I4s", len(data), b"BIN\0") + data)
    return {"cube.obj": cube(half).encode(), "text.stl": f"solid cube\n{text}endsolid cube\n".encode(),
            "cube.stl": bytes(80) + struct.pack("<I", len(triangles)) +
            b"".join(bytes(12) + n + bytes(2) for n in numbers),
            "cube.ply": ply.encode(), "cube.glb": glb}


def start_browser() -> webdriver.Chrome:
    options = Options()
    for flag in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--window-size=1000,800",
                 "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-background-networking"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service("chromedriver"), options=options)


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


def serve(folder: Path) -> str:
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=folder))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return f"http://127.0.0.1:{server.server_port}"


def native(problems: list, *flags: str, meshes=(ASSETS / "mug.obj", ASSETS / "dish_rack.obj"), scales=(1, 1)) -> list:
    """What build/svcd answers: (collides, time, status, us) for each pair of poses, seven numbers each as text."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "problems.txt"
        lines = ["nsvcd-problems 1", f"mesh a {meshes[0]}", f"mesh b {meshes[1]}"]
        for start, end in problems:
            lines += [f"problem p a {scales[0]} b {scales[1]} 0 0 0 0 0 0 1 -1 nan 2", start, end]
        path.write_text("\n".join(lines) + "\n")
        out = subprocess.run([SVCD, "check", *flags, path], check=True, capture_output=True, text=True).stdout
    rows = [line.split("\t") for line in out.splitlines()]
    return [(row[2] == "1", float(row[3]), row[6], float(row[7])) for row in rows]


def random_pose(rng: random.Random) -> str:
    place = [rng.uniform(-0.3, 0.3), rng.uniform(-0.4, 0.4), rng.uniform(0.0, 0.3)]
    turn = [rng.gauss(0, 1) for _ in range(4)]
    return " ".join(f"{x:.6f}" for x in place + [x / math.hypot(*turn) for x in turn])


def read_mesh(path: Path) -> tuple:
    """Vertices, and triangles by numbers of theirs, of an OBJ file that has nothing else."""
    lines = [line.split() for line in path.read_text().splitlines()]
    vertices = [tuple(float(x) for x in line[1:]) for line in lines if line[:1] == ["v"]]
    return vertices, [[int(v) - 1 for v in line[1:]] for line in lines if line[:1] == ["f"]]


def subtract(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def place(start: list, end: list, t: float, a) -> list:
    """A point of the moving body at a time: positions linear, rotations slerped on the shorter arc."""
    cosine = sum(x * y for x, y in zip(start[3:], end[3:]))
    sign = -1 if cosine < 0 else 1
    angle = math.acos(min(1, abs(cosine)))
    weights = math.sin((1 - t) * angle), sign * math.sin(t * angle)
    turn = [weights[0] * x + weights[1] * y for x, y in zip(start[3:], end[3:])]
    *axis, w = (x / math.hypot(*turn) for x in turn)
    twist = [x + w * y for x, y in zip(cross(axis, a), a)]
    position = [(1 - t) * x + t * y for x, y in zip(start, end[:3])]
    return [p + x + 2 * y for p, x, y in zip(position, a, cross(axis, twist))]


HIGH = ("0 -0.4 0.3 0 0 0 1", "0 0.4 0.3 0 0 0 1")  # over the rack
TITLES = {"witness": "Hit", "certified-free": "Free", "inside": "Inside", "undecided": "Undecided"}


class Hands(unittest.TestCase):
    """Hands and eyes for one page, in a browser of its own."""

    page = PAGE

    @classmethod
    def setUpClass(cls):
        cls.browser = start_browser()
        cls.address = serve(PAGE.parent) + "/" + cls.page.name

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()

    def setUp(self):
        self.open(self.address)

    def tearDown(self):
        self.assertEqual(self.browser.get_log("browser"), [])

    def until(self, condition, seconds=10):
        end = time.monotonic() + seconds
        while not condition():
            self.assertLess(time.monotonic(), end, "nothing comes of it")
            time.sleep(0.02)

    def find(self, name: str):
        return self.browser.find_element(By.ID, name)

    def text(self, name: str) -> str:
        return self.find(name).text

    def frames(self):
        """Waits until what was done has been answered and drawn."""
        self.browser.execute_async_script(
            "requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(arguments[0])))")

    def click(self, selector: str):
        self.browser.find_element(By.CSS_SELECTOR, selector).click()
        self.frames()

    def other(self) -> str:
        """The address of the other page."""
        return self.browser.find_element(By.CSS_SELECTOR, "header a[href$='.html']").get_attribute("href")


class Page(Hands):
    def open(self, address: str):
        self.browser.get(address)
        self.until(lambda: self.text("verdict-title") != "Loading")

    def set(self, name: str, value, event="input", wait=True):
        self.browser.execute_script(
            "arguments[0].value = arguments[1]; arguments[0].dispatchEvent(new Event(arguments[2], {bubbles: true}))",
            self.find(name) if isinstance(name, str) else name, str(value), event)
        if wait:
            self.frames()

    def poses(self) -> tuple:
        self.frames()
        return tuple(self.find(f"pose-{i}").get_attribute("value") for i in (0, 1))

    def set_poses(self, start: str, end: str):
        self.set("pose-0", start, "change", wait=False)
        self.set("pose-1", end, "change")

    def drag(self, element, x: int, y: int, from_x=0, from_y=0, shift=False):
        actions = ActionChains(self.browser, duration=20)
        if shift:
            actions.key_down(Keys.SHIFT)
        actions.move_to_element_with_offset(element, from_x, from_y).click_and_hold()
        for _ in range(4):
            actions.move_by_offset(x // 4, y // 4)
        actions.release()
        if shift:
            actions.key_up(Keys.SHIFT)
        actions.perform()
        self.frames()

    def facts(self) -> str:
        return "".join(element.text for element in self.browser.find_elements(By.CLASS_NAME, "facts"))

    def drop(self, which: int, files: list):
        """Drops files of [name, text or bytes] on the card of A (0) or B (1), as the browser would."""
        self.drop_on(self.find(f"drop-{which}"), files)

    def drop_on(self, element, files: list, at=(0, 0)):
        coded = [[name, base64.b64encode(data.encode() if isinstance(data, str) else data).decode()]
                 for name, data in files]
        self.browser.execute_script("""
            const data = new DataTransfer();
            for (const [name, coded] of arguments[1])
              data.items.add(new File([Uint8Array.from(atob(coded), (c) => c.charCodeAt(0))], name));
            for (const kind of ['dragover', 'drop'])
              arguments[0].dispatchEvent(new DragEvent(kind, {dataTransfer: data, bubbles: true, cancelable: true,
                clientX: arguments[2][0], clientY: arguments[2][1]}));
            """, element, coded, at)
        self.frames()
        time.sleep(0.2)  # reading a file takes a while, and has no event of its own
        self.until(lambda: "reading" not in self.facts())
        self.frames()

    def name(self, which: int) -> str:
        return self.find(f"drop-{which}").find_element(By.CLASS_NAME, "name").text

    def part(self, which: int, kind: str):
        return self.find(f"drop-{which}").find_element(By.CLASS_NAME, kind)

    def look(self, width: int, height: int):
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                     {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 800})
        self.frames()

    def link(self) -> str:
        """The page's link, when nothing has moved for a while."""
        time.sleep(0.5)
        return self.browser.execute_script("return location.hash")

    def error(self, which: int) -> str:
        return self.find(f"drop-{which}").find_element(By.CLASS_NAME, "error").text

    def taken(self) -> float:
        """What the page shows, in microseconds."""
        number, unit = self.text("microseconds").split()
        return float(number) * {"µs": 1, "ms": 1000}[unit]

    def contact(self):
        shown = self.text("contact-time")  # of what is free: when it is nearest
        return float(shown[4:]) if shown.startswith("t = ") and self.text("contact-name").endswith("contact at") else None

    def assert_native(self, expected: tuple):
        """The page says what build/svcd says, of times within twice the tolerance of a first contact."""
        _, contact, status, _ = expected
        self.assertEqual(self.text("verdict-title"), TITLES[status])
        if status == "witness":
            self.assertAlmostEqual(self.contact(), contact, delta=2 * FIRST)
        else:
            self.assertIsNone(self.contact())

    # ---- tests

    def test_opens_from_a_file(self):
        self.open(PAGE.as_uri())
        self.assert_native(native([self.poses()], "--first", "0.01")[0])
        self.assertEqual(self.other(), PAGE.with_name("throw.html").as_uri())

    def test_drags(self):
        grip = self.find("grip-1")
        before = self.poses()
        self.assertEqual(self.text("verdict-title"), "Hit")
        self.drag(grip, -120, -160)
        after = self.poses()
        self.assertEqual(after[0], before[0])
        (_, y, z, *turn), (_, old_y, old_z, *old_turn) = ([float(x) for x in p[1].split()] for p in (after, before))
        self.assertTrue(y < old_y and z > old_z, "to the left and up, as the camera stands")
        self.assertEqual(turn, old_turn)
        self.assert_native(native([after], "--first", "0.01")[0])
        self.assertEqual(self.text("verdict-title"), "Free")

        self.drag(grip, 40, 40, shift=True)
        turned = self.poses()
        self.assertNotEqual(turned[1].split()[3:], after[1].split()[3:])
        self.click("[name=drag][value=turn]")
        self.drag(grip, 40, 0)
        self.assertNotEqual(self.poses(), turned)
        self.click("#reset-motion")
        self.assertEqual(self.poses(), before)

    def test_drags_the_body_itself_or_the_view(self):
        before = self.poses()
        grip = self.find("grip-0")
        view = self.find("canvas")
        place = [grip.rect[k] + grip.rect[s] / 2 - view.rect[k] - view.rect[s] / 2
                 for k, s in (("x", "width"), ("y", "height"))]
        self.drag(view, -40, 40, int(place[0]), int(place[1]) + 60)  # the mug is below its label
        after = self.poses()
        self.assertNotEqual(after[0], before[0])
        self.assertEqual(after[1], before[1])
        label = grip.rect
        self.drag(view, 100, 20, int(-view.rect["width"] / 2) + 40, int(-view.rect["height"] / 2) + 40)
        self.assertEqual(self.poses(), after)
        self.assertNotEqual(grip.rect, label, "the view turns")

    def test_keys(self):
        before = self.poses()
        self.find("grip-1").send_keys(Keys.ARROW_UP * 20)
        raised = self.poses()
        self.assertGreater(float(raised[1].split()[2]), float(before[1].split()[2]))
        self.find("grip-1").send_keys(Keys.SHIFT, Keys.ARROW_LEFT)
        self.assertNotEqual(self.poses()[1].split()[3:], raised[1].split()[3:])
        label = self.find("grip-0").rect
        self.find("canvas").send_keys(Keys.ARROW_LEFT)
        self.frames()
        self.assertNotEqual(self.find("grip-0").rect, label)

    def test_what_is_read_aloud(self):
        """One sentence when nothing moves; all that has the focus has a name."""
        def said() -> str:
            return self.find("said").get_attribute("textContent")

        self.until(said)
        self.assertEqual(said(), f"Hit. {self.text('verdict-text')} contact at {self.text('contact-time')}.")
        self.browser.execute_script("""
            window.heard = [];
            const keep = () => heard.push(document.getElementById('said').textContent);
            new MutationObserver(keep).observe(document.getElementById('said'), {childList: true});""")
        self.drag(self.find("grip-1"), -120, -160)
        self.until(lambda: said().startswith("Free"))
        time.sleep(1)
        heard = self.browser.execute_script("return heard")
        self.assertEqual(len(heard), 1, heard)
        self.assertIn(f"nearest at {self.text('contact-time')}. Apart by {self.text('apart')}.", heard[0])
        nodes = self.browser.execute_cdp_cmd("Accessibility.getFullAXTree", {})["nodes"]
        nodes = [[node["role"]["value"], node.get("name", {}).get("value"), {p["name"]: p["value"].get("value") for p in
                  node.get("properties", [])}] for node in nodes if not node["ignored"]]
        self.assertEqual([node for node in nodes if node[2].get("focusable") and not node[1]], [])
        self.assertEqual({role for role, _, facts in nodes if facts.get("live", "off") != "off"} - {"status", "alert"}, set())
        def current() -> list:
            return [link.text for link in self.browser.find_elements(By.CSS_SELECTOR, "[aria-current=true]")]

        self.assertEqual((current(), self.text("note")), ([], "mug.obj moves, dish_rack.obj rests."))
        self.click("#reset-motion")
        self.assertEqual((current(), self.text("note")), (["Mug"], "A mug is carried into a dish rack."))

    def test_answers_are_those_of_svcd(self):
        rng = random.Random(7)
        problems = [(random_pose(rng), random_pose(rng)) for _ in range(20)]
        expected = native(problems, "--first", "0.01", "--repeat", "50")
        ratios, times = [], []
        for (start, end), answer in zip(problems, expected):
            self.set_poses(start, end)
            with self.subTest(start=start, end=end):
                self.assert_native(answer)
            times.append(self.taken())
            ratios.append(times[-1] / answer[3])
        self.assertEqual({status for _, _, status, _ in expected}, {"witness", "certified-free"})
        median = sorted(times)[len(times) // 2]
        print(f"test_page: {len(times)} random questions, first contacts: median {median:.1f} us in the page, "
              f"{sorted(a[3] for a in expected)[len(times) // 2]:.1f} in build/svcd; "
              f"median ratio {sorted(ratios)[len(ratios) // 2]:.2f}", flush=True)
        self.assertLess(median, SLOWEST)

    def test_time_of_the_first_question(self):
        for flags in (("--first", "0.01"), ()):
            time.sleep(1.5)  # it looks at the clock again when nothing moves
            taken = self.taken()
            alone = native([self.poses()], *flags, "--repeat", "1000")[0][3]
            print(f"test_page: the question that the page opens with, {'first' if flags else 'any'} contact: "
                  f"{taken} us, in build/svcd at best {alone}", flush=True)
            self.assertLess(taken, SLOWEST)
            if flags:
                self.browser.set_window_size(1180, 800)
                self.click("#reset-view")
                self.browser.save_screenshot(str(PICTURE))
                self.browser.set_window_size(1000, 800)
                self.click("#first")

    def test_options(self):
        poses = self.poses()
        self.click("#first")
        self.assertEqual((self.text("free-until"), self.text("contact-name")), ("–", "a contact at"))
        self.assertIn("perhaps not for the first time", self.text("verdict-text"))
        self.assertAlmostEqual(self.contact(), native([poses])[0][1], delta=2e-3)
        self.click("#first")
        self.set_poses(*HIGH)
        self.assertEqual(self.text("verdict-title"), "Free")
        for millimetres in (100, 250):
            self.set("clearance", millimetres)
            status = native([HIGH], "--first", "0.01", "--clearance", str(millimetres / 1000))[0][2]
            self.assertEqual(self.text("verdict-title"),
                             "Free" if status == "certified-free" else f"Closer than {millimetres} mm")
        self.assertEqual(status, "witness")
        self.set("clearance", -1)
        self.assertEqual(self.text("verdict-title"), "Not answered")
        self.assertIn("clearance is negative", self.text("verdict-text"))
        self.set("clearance", 0)
        self.assertEqual(self.text("verdict-title"), "Free")
        self.click("#reset-motion")
        self.click("[name=method][value=network]")
        self.assertEqual(self.text("verdict-title"), "Probably hits")
        self.assertIn("opinion", self.text("verdict-text"))
        self.assertEqual(self.text("contact-name"), "guessed at")

    def test_slider(self):
        contact = self.text("time-text")
        self.assertEqual(float(contact), self.contact())
        self.set("time", "0.300")
        self.assertEqual(self.text("time-text"), "0.300")
        self.assertFalse(self.find("follow").is_selected())
        self.click("#follow")
        self.assertEqual(self.text("time-text"), contact)
        self.find("play").click()
        self.until(lambda: 0 < float(self.text("time-text")) < float(contact))
        self.click("#play")
        paused = self.text("time-text")
        self.assertEqual(self.text("play"), "Play")
        time.sleep(0.3)
        self.assertEqual(self.text("time-text"), paused)
        self.find("play").click()
        self.assertEqual(self.text("play"), "Pause")
        self.until(lambda: self.text("time-text") == contact and self.find("follow").is_selected())
        self.click("#follow")
        self.find("play").click()
        self.until(lambda: self.text("time-text") == "1.000")
        self.frames()
        self.assertEqual((self.text("time-text"), self.find("follow").is_selected()), ("1.000", False))

    def test_picture(self):
        self.click("[name=method][value=network]")  # has no witness, whose pixels SwiftShader varies
        pictures = []
        for t in ("0.300", "0.340", "0.300"):  # no ghost is there
            self.set("time", t)
            pictures.append(self.find("canvas").screenshot_as_base64)
        self.assertEqual(pictures[0], pictures[2])
        self.assertNotEqual(pictures[0], pictures[1], "A is drawn where it is")

    def test_witness(self):
        """The point is in the planes of the two triangles, and between their corners, to a millimetre."""
        start, end = ([float(x) for x in pose.split()] for pose in self.poses())
        point = [float(x) for x in self.text("point").split(",")]
        for which, mesh in enumerate(("mug.obj", "dish_rack.obj")):
            vertices, faces = read_mesh(ASSETS / mesh)
            corners = [vertices[v] for v in faces[int(self.text(f"triangle-{which}"))]]
            if which == 0:
                corners = [place(start, end, self.contact(), corner) for corner in corners]
            normal = cross(*(subtract(corner, corners[0]) for corner in corners[1:]))
            height = sum(n * x for n, x in zip(normal, subtract(point, corners[0]))) / math.hypot(*normal)
            self.assertLess(abs(height), 1e-3)
            for x, among in zip(point, zip(*corners)):
                self.assertTrue(min(among) - 1e-3 < x < max(among) + 1e-3)

    def test_numbers(self):
        before = self.poses()
        self.set("pose-1", "0 0 0.3 0 0 0 2", "change")
        self.find("pose-1").find_element(By.XPATH, "ancestor::details/summary").click()
        self.assertIn("not of unit length", self.text("pose-error"))
        self.set("pose-1", "1 2 3", "change")
        self.assertIn("seven numbers", self.text("pose-error"))
        self.set("pose-1", "0 0 0.3 0 0 zero 1", "change")
        self.assertIn("“zero” is not a number", self.text("pose-error"))
        self.click("#reset-motion")
        self.assertEqual(self.text("pose-error"), "")
        self.set("pose-0", before[0], "change")
        self.assertEqual(self.text("pose-error"), "", "the end is what it was")
        self.assert_native(native([before], "--first", "0.01")[0])

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            meshes = [Path(folder) / "small.obj", Path(folder) / "large.obj"]
            for path, half in zip(meshes, (0.1, 0.5)):
                path.write_text(cube(half))
            self.drop(0, [["small.obj", cube(0.1)]])
            self.assertIn("A: small.obj", self.text("drop-0"))
            self.assertIn("0.2 × 0.2 × 0.2 m", self.text("drop-0"))
            self.find("drop-1").find_element(By.CSS_SELECTOR, "[type=file]").send_keys(str(meshes[1]))
            self.until(lambda: "B: large.obj" in self.text("drop-1"))
            self.assert_native(native([self.poses()], "--first", "0.01", meshes=meshes)[0])
            self.assertEqual(self.text("verdict-title"), "Hit")
            upright = "0 0 0 1"
            cases = (  # inside at the start; 10 um above it; past it
                ("inside", (f"0 0 0 {upright}", f"0 0 2 {upright}")),
                ("certified-free", (f"0 0 0.60001 {upright}", f"0.1 0 0.60001 {upright}")),
                ("certified-free", (f"0 -1 0.7 {upright}", f"0 1 0.7 {upright}")),
            )
            for status, poses in cases:
                self.set_poses(*poses)
                expected = native([poses], "--first", "0.01", meshes=meshes)[0]
                self.assertEqual(expected[2], status)
                self.assert_native(expected)
            scale = self.find("drop-0").find_element(By.CLASS_NAME, "scale")
            self.set(scale, 2.5)
            self.assertIn("0.5 × 0.5 × 0.5 m", self.text("drop-0"))
            self.assert_native(native([poses], "--first", "0.01", meshes=meshes, scales=(2.5, 1))[0])
            self.assertEqual(self.text("verdict-title"), "Hit")
            self.set(scale, -1)
            self.assertIn("scale", self.text("verdict-text"))
            self.set(scale, 1)
            self.assertEqual(self.text("verdict-title"), "Free")
        self.drop(1, [["one.obj", cube(0.3)], ["two.obj", cube(0.2)]])
        self.assertEqual([self.name(0), self.name(1)], ["A: one.obj", "B: two.obj"])

    def save(self, folder: Path):
        """Saves the proof into a new folder; the flags that build/verify is to have."""
        self.save_files(folder)
        size = (folder / "proof.cert").stat().st_size
        self.assertEqual(self.text("save"), f"Save the proof, {size} bytes")
        command = (folder / "proof.txt").read_text().split("\n")[0].split("#")[1].split()
        self.assertEqual(command[:3], ["build/verify", "proof/proof.txt", "proof"])
        return command[3:]

    def test_proofs(self):
        """Each that is saved is accepted, of its own motion and of no other."""
        saved = {}
        with tempfile.TemporaryDirectory() as folder:
            def save(kind: str):
                saved[kind] = Path(folder) / kind, self.save(Path(folder) / kind)

            save("hit")
            self.assertEqual((saved["hit"][0] / "b.obj").read_bytes(), (ASSETS / "dish_rack.obj").read_bytes())
            self.set_poses(*HIGH)
            save("free")
            self.set("clearance", 250)
            save("near")
            self.set("clearance", 0)
            self.drop(0, [["a # b.obj", cube(0.1)], ["large\n.obj", cube(0.5)]])
            self.set_poses("0.1 0.2 0.3 0 0 0 1", "0 0 2 0.6 0 0 0.8")
            save("inside")
            for kind, (path, _) in saved.items():
                for other, (motion, flags) in saved.items():
                    out = subprocess.run([VERIFY, motion / "proof.txt", path, *flags], capture_output=True, text=True)
                    verdict = ["accepted", kind] if kind == other else ["refused"]
                    self.assertEqual(out.stdout.split("\t")[1:][:len(verdict)], verdict, (kind, other, out))
        # within what is a solid but for half a face: undecided
        open_cube = cube(0.5).rstrip("\n").rsplit(" ", 1)[0] + "\n"
        self.drop(0, [["small.obj", cube(0.1)], ["open.obj", open_cube]])
        self.set_poses("0 0 0 0 0 0 1", "0.1 0 0 0 0 0 1")
        self.until(lambda: "proven" in self.text("why"))
        self.assertFalse(self.find("save").is_enabled())

    def test_wrong_files(self):
        before = self.poses()
        wrong = {
            "v 0 0 0\nv 1 0 0\nf 1 2\n": "wrong.obj, line 3: a line cannot be understood",
            "v 0 0 0\nv 1 0 0\nv 0 1 0\n\nf 1 2 9\n": "wrong.obj, line 5: an index is zero or refers to no vertex",
            "v 0 0 zero\n" + CUBE_FACES: "wrong.obj, line 1: a line cannot be understood",
            "": "wrong.obj: the file is empty",
            "\u0000\u0001PNG": "wrong.obj",
        }
        for text, message in wrong.items():
            self.drop(1, [["wrong.obj", text]])
            self.assertIn(message, self.error(1))
            self.assertIn("B: dish_rack.obj", self.text("drop-1"))
        self.assertEqual(self.poses(), before)
        self.drag(self.find("grip-1"), -120, -160)
        self.assertEqual(self.text("verdict-title"), "Free")
        self.drop(1, [["right.obj", cube(0.1)]])
        self.assertEqual(self.error(1), "")
        missed = self.browser.execute_script(
            "return document.body.dispatchEvent(new DragEvent('drop', {bubbles: true, cancelable: true}))")
        self.assertFalse(missed, "a file that misses would replace the page")

    def test_formats(self):
        """Each format is the same cube: the same answer, and a proof of it."""
        with tempfile.TemporaryDirectory() as folder:
            other = Path(folder) / "large.obj"
            other.write_text(cube(0.5))
            self.drop(1, [["large.obj", cube(0.5)]])
            for i, (name, data) in enumerate(formats(0.1).items()):
                mesh = Path(folder) / name
                mesh.write_bytes(data)
                self.drop(0, [[name, data]])
                self.assertEqual((self.name(0), self.error(0)), (f"A: {name}", ""))
                self.assertIn(f"{name[-3:].upper()}, 12 triangles", self.part(0, "facts").text)
                self.assertIn("0.2 × 0.2 × 0.2 m", self.text("drop-0"))
                self.set_poses("0 -1 0.7 0 0 0 1", "0 1 0.55 0 0 0 1")
                self.assert_native(native([self.poses()], "--first", "0.01", meshes=(mesh, other))[0])
                self.assert_accepted(Path(folder) / f"proof-{i}")

    def assert_accepted(self, folder: Path):
        flags = self.save(folder)
        out = subprocess.run([VERIFY, folder / "proof.txt", folder, *flags], capture_output=True, text=True)
        self.assertIn("\taccepted\t", out.stdout, out)

    def test_broken_files(self):
        good = formats(0.1)
        broken = {
            "text.stl": good["text.stl"].replace(b"vertex", b"vertexx", 1), "cube.stl": good["cube.stl"][:-70],
            "cube.ply": good["cube.ply"].replace(b"element vertex 8", b"element vertex x"),
            "short.ply": good["cube.ply"][:-30], "cube.glb": good["cube.glb"][:-40], "empty.glb": b"",
            "head.glb": b"glTF" + bytes(8), "part.step": b"ISO-10303-21;", "<img src=x onerror=alert(1)>.obj": b"f 1 2 3",
        }
        before = self.name(0)
        for name, data in broken.items():
            self.drop(0, [[name, data]])
            self.assertTrue(self.error(0).startswith(name), (name, self.error(0)))
            self.assertIn(name, self.text("notice")[:1].lower() + self.text("notice")[1:])
            self.assertEqual(self.name(0), before)
        self.assertEqual(self.browser.find_elements(By.CSS_SELECTOR, "img"), [])
        self.drop(0, [["right.obj", cube(0.1)]])
        self.assertEqual((self.error(0), self.find("notice").is_displayed()), ("", False))

    def test_drops_anywhere(self):
        def middle(element):
            return element.rect["x"] + element.rect["width"] / 2, element.rect["y"] + element.rect["height"] / 2

        canvas = self.find("canvas")
        self.set("time", "0.000")
        start = middle(self.find("grip-0"))
        self.drop_on(canvas, [["on_a.obj", cube(0.05)]], (start[0], start[1] + 45))
        self.assertEqual([self.name(0), self.name(1)], ["A: on_a.obj", "B: dish_rack.obj"])
        self.drop_on(canvas, [["on_b.obj", cube(0.2)]], middle(canvas))  # they meet there
        self.assertEqual(sorted((self.name(0), self.name(1)))[0][:3], "A: ")
        self.click("#gallery a")
        self.until(lambda: self.name(1) == "B: dish_rack.obj")
        body = self.browser.find_element(By.TAG_NAME, "h1")
        for expected in (["A: 1.obj", "B: dish_rack.obj"], ["A: 1.obj", "B: 2.obj"], ["A: 3.obj", "B: 2.obj"]):
            n = max(int(name[3]) for name in expected if name[3].isdigit())
            self.drop_on(body, [[f"{n}.obj", cube(0.1 * n)]])
            self.assertEqual([self.name(0), self.name(1)], expected)
        self.drop_on(body, [[f"{n}.obj", cube(0.1)] for n in (7, 8, 9)])
        self.assertEqual([self.name(0), self.name(1)], ["A: 7.obj", "B: 8.obj"])
        self.assertIn("two", self.text("notice"))
        self.open(self.address + "#v=1&scene=arm")
        self.until_scene("arm")
        self.drop_on(self.browser.find_element(By.TAG_NAME, "h1"), [["one.obj", cube(0.1)]])
        self.assertEqual([self.name(0), self.name(1)], ["A: one.obj", "B: dish_rack.obj"])

    def test_units_are_offered(self):
        self.assertFalse(self.part(0, "units").is_displayed())
        self.drop(0, [["part.obj", cube(60)]])  # 120 mm
        self.assertIn("120 × 120 × 120 m", self.text("drop-0"))
        self.assertIn("millimetres: use 0.001", self.part(0, "units").text)
        self.assertEqual(self.text("verdict-title"), "In which unit?")  # before any answer
        self.assertIn("part.obj would be 120 m long", self.text("verdict-text"))
        self.assertFalse(self.find("microseconds").is_displayed() or self.find("save").is_displayed())
        self.find("unit-keep").click()
        self.until(lambda: self.text("verdict-title") == "Hit")
        self.assertFalse(self.find("unit").is_displayed())
        self.drop(0, [["part.obj", cube(60)]])
        self.assertIn("part.obj moves, dish_rack.obj rests", self.text("note"))
        self.find("unit-use").click()
        self.frames()
        self.assertFalse(self.find("unit").is_displayed())
        self.drop(0, [["part.obj", cube(60)]])
        self.part(0, "units").click()
        self.frames()
        self.assertIn("0.12 × 0.12 × 0.12 m", self.text("drop-0"))
        self.assertFalse(self.part(0, "units").is_displayed())
        self.assertEqual(self.text("verdict-title"), "Hit")
        self.drop(0, [["nut.obj", cube(10)]])  # 20 mm, beside a rack of 0.4 m: 48 times as large
        self.assertFalse(self.part(0, "units").is_displayed())
        self.drop(0, [["bolt.obj", cube(14.9)]])
        self.drop(1, [["small.obj", cube(0.1)]])
        self.assertIn("use 0.001", self.part(0, "units").text, "they differ too much")
        self.drop(1, [["tiny.obj", cube(0.0001)]])
        self.assertIn("1000", self.part(1, "units").text)

    def test_free_says_where_it_is_nearest(self):
        self.set_poses(*HIGH)
        self.until(lambda: self.text("contact-name") == "nearest at" and self.text("point") != "–")
        poses = [",".join(pose.split()) for pose in HIGH]
        out = subprocess.run([SVCD, "sweep", ASSETS / "mug.obj", ASSETS / "dish_rack.obj", f"--from={poses[0]}",
                              f"--to={poses[1]}", "--measure", "1e-5"], capture_output=True, text=True).stdout
        low, high = re.search(r"clearance +(\S+) to (\S+) m", out).groups()
        shown = float(self.text("apart").split()[0]) / 1000
        self.assertLess(float(low) - 1e-4, shown)
        self.assertLess(shown, float(high) + 1e-4)
        self.assertTrue(self.find("contact").is_displayed(), "a ring is where it is nearest")
        self.set_poses(*HIGH[::-1])
        self.until(lambda: self.text("point") != "–")
        self.click("#gallery a")
        self.until(lambda: self.text("contact-name") == "contact at")

    def test_copied_questions_run(self):
        """What is copied for a terminal, for Python and for C says what the page says."""
        def copied(language: str) -> str:
            self.click(f"#copies [value={language}]")
            self.until(lambda: "opied" in self.text("copied"))
            self.assertIn("the folder of the repository", self.text("copied"))
            return self.find("copied-text").get_attribute("textContent")

        root = Path(__file__).resolve().parents[2]
        shown = float(self.text("contact-time").split()[-1])
        for poses, clearance in ((None, 0), (HIGH, 0), (HIGH, 250)):
            if poses:
                self.set_poses(*poses)
            self.set("clearance", clearance)
            verdict = "free" if self.text("verdict-title") == "Free" else "hit"
            command = ["sh", "-c", copied("svcd").replace("svcd", str(SVCD), 1)]
            out = subprocess.run(command, capture_output=True, text=True, cwd=root)
            self.assertEqual(out.stdout[:len(verdict)], verdict, (command, out))
            with tempfile.TemporaryDirectory() as folder:
                (Path(folder) / "q.c").write_text(copied("C"))
                build = ["cc", "-O0", "-DNSVCD_NO_DISPATCH", "-Wall", "-Werror", "-I.", f"{folder}/q.c", "-lm", "-o", f"{folder}/q"]
                self.assertEqual(subprocess.run(build, capture_output=True, text=True, cwd=root).stderr, "")
                out = subprocess.run([f"{folder}/q"], capture_output=True, text=True, cwd=root).stdout
            self.assertEqual(out.split(",")[0], verdict)
            if clearance == 0 and verdict == "hit":
                self.assertAlmostEqual(float(out.split()[-1]), shown, delta=0.011)
            compile(copied("Python"), "copied", "exec")
            if (root / "build/_neuralsvcd.so").exists():
                out = subprocess.run([sys.executable, "-c", copied("Python")], capture_output=True, text=True, cwd=root,
                                     env={**os.environ, "PYTHONPATH": str(root / "examples/python")})
                self.assertEqual(out.stdout.split()[:1], [verdict], out)

    def test_what_is_copied_is_told_truly(self):
        """Whose the files are, that the browser has refused, and that C does not read all formats."""
        files = formats(0.1)
        self.drop(0, [["my cube.stl", files["cube.stl"]]])
        self.browser.execute_script("navigator.clipboard.writeText = () => Promise.reject(new Error('no'))")
        self.click("#copies [value=C]")
        self.until(lambda: self.text("copied"))
        for words in ("did not let", "my cube.stl (yours)", "examples/assets/dish_rack.obj (the repository)"):
            self.assertIn(words, self.text("copied"))
        self.assertIn("nsvcd_mesh_load", self.text("copied-text"))
        self.click("#copy")
        self.assertIn("did not let", self.text("notice"))
        self.assertIn("no files: who opens it has to drop my cube.stl", self.text("notice"))
        self.browser.execute_script("navigator.clipboard.writeText = () => Promise.resolve()")
        self.click("#copies [value=svcd]")
        self.until(lambda: self.text("copied").startswith("Copied, for a folder with"))
        self.set_poses(*HIGH)
        self.assertEqual(self.text("copied") + self.text("copied-text"), "", "it is of another motion")
        self.drop(0, [["cube.ply", files["cube.ply"]]])
        self.assertFalse(self.browser.find_element(By.CSS_SELECTOR, "#copies [value=C]").is_enabled())
        self.assertIn("not PLY", self.text("no-c"))

    def test_findings_are_those_of_info(self):
        lines = cube(0.1).splitlines()
        bad = {"open.obj": "\n".join(lines[:-1]) + "\n",
               "turned.obj": "\n".join(lines[:-1] + ["f 6 8 4 2"]) + "\n",
               "inside_out.obj": "\n".join(lines[:8] + ["f " + " ".join(line.split()[:0:-1]) for line in lines[8:]]) + "\n",
               "good.obj": cube(0.1)}
        with tempfile.TemporaryDirectory() as folder:
            for name, text in bad.items():
                path = Path(folder) / name
                path.write_text(text)
                out = subprocess.run([SVCD, "info", path], capture_output=True, text=True).stdout
                expected = [re.sub(r" \(say --.*", "", line.split(": ", 1)[1])  # options of svcd, which a page has none of
                            for line in out.splitlines() if line.startswith("wrong: ")]
                self.drop(0, [[name, text]])
                shown = [item.text for item in self.part(0, "findings").find_elements(By.TAG_NAME, "li")]
                self.assertEqual(shown, expected)
                self.assertEqual(bool(shown), name != "good.obj")

    def test_gallery(self):
        """Each scene is a click away; its answer is build/svcd's, its proof build/verify's."""
        titles = {}
        for link in self.browser.find_elements(By.CSS_SELECTOR, "#gallery a[href^='#']"):
            name = link.get_attribute("href").split("scene=")[1]
            link.click()
            self.until_scene(name)
            self.assertEqual(self.find("notice").is_displayed(), False)
            titles[name] = self.text("verdict-title")
            with tempfile.TemporaryDirectory() as folder, self.subTest(scene=name):
                if name == "arm":
                    self.assert_arm_accepted(Path(folder) / "proof")
                    continue
                self.assert_accepted(Path(folder) / "proof")
                out = subprocess.run([SVCD, "check", "--first", "0.01", Path(folder) / "proof" / "proof.txt"],
                                     check=True, capture_output=True, text=True).stdout.split("\t")
                self.assert_native((out[2] == "1", float(out[3]), out[6], float(out[7])))
                for which in (0, 1):
                    self.assertEqual(self.part(which, "findings").text, "", "nothing is wrong with its meshes")
        self.assertEqual(tuple(titles), SCENES)
        self.assertEqual(titles, {"mug": "Hit", "stairs": "Hit", "arm": "Free", "ring": "Free", "needle": "Hit"})

    def until_scene(self, name: str):
        """A link is followed a while after it is clicked."""
        self.until(lambda: self.browser.execute_script("return document.body.dataset.scene") == name)
        self.frames()

    def save_files(self, folder: Path):
        folder.mkdir()
        self.browser.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(folder)})
        self.until(self.find("save").is_enabled)
        self.find("save").click()
        saved = folder / "proof.tar"
        self.until(lambda: saved.exists() and saved.stat().st_size > 0)  # it is made empty first
        with tarfile.open(folder / "proof.tar") as tar:
            tar.extractall(folder)
        for file in (folder / "proof").iterdir():
            file.rename(folder / file.name)

    def assert_arm_accepted(self, folder: Path):
        self.save_files(folder)
        out = subprocess.run([VERIFY, folder / "arm.txt", folder], capture_output=True, text=True)
        self.assertEqual(out.stdout.split("\t")[:3], ["up", "accepted", "free"], out)

    def test_arm(self):
        """Bent, it is free with a proof of its own, or hits as build/svcd says of many points on its way."""
        self.open(self.address + "#v=1&scene=arm")
        self.until_scene("arm")
        self.assertEqual(self.text("verdict-title"), "Free")
        seen = set()
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            self.assert_arm_accepted(folder / "plan")
            data = (folder / "plan" / "up.cert").read_bytes()
            pieces, degree, joints = struct.unpack_from("<III", data, 4)
            times = struct.unpack_from(f"<{pieces + 1}d", data, 16)
            rows = pieces * degree
            plan = struct.unpack_from(f"<{(rows + 1) * joints}d", data, 24 + 8 * pieces)
            self.assertGreater(times[-1], 1)
            for n, bend in enumerate(([1, 0, 0, 0, 0, 0], [0, 40, 0, 0, 0, 0], [0, 0, 0, 0, 0, 12], [0, 0, 0, -60, 0, 60])):
                for slider, degrees in zip(self.browser.find_elements(By.CSS_SELECTOR, "#bends input"), bend):
                    self.set(slider, degrees, wait=False)
                self.frames()
                verdict = self.text("verdict-title")
                seen.add(verdict)
                points = [plan[i] + math.radians(bend[i % joints]) * math.sin(math.pi * (i // joints) / rows) ** 2
                          for i in range(len(plan))]
                lines = [f"path p shelf {pieces * 20 + 1}"]
                for k in range(pieces * 20 + 1):
                    piece, t = min(k // 20, pieces - 1), k / 20 - min(k // 20, pieces - 1)
                    weights = [math.comb(degree, j) * t ** j * (1 - t) ** (degree - j) for j in range(degree + 1)]
                    lines.append(" ".join(f"{sum(w * points[(piece * degree + j) * joints + a] for j, w in enumerate(weights)):.9f}"
                                          for a in range(joints)))
                path = folder / "plan" / f"path-{n}.txt"
                robot = [line for line in (folder / "plan" / "arm.txt").read_text().splitlines()
                         if not line.startswith("plan")]
                path.write_text("\n".join(robot + lines) + "\n")
                out = subprocess.run([SVCD, "path", path], capture_output=True, text=True).stdout.split("\t")
                self.assertEqual(verdict, {"certified": "Free", "free": "Free", "hit": "Hit"}.get(out[1]), (bend, out))
                if verdict == "Free":
                    self.assert_arm_accepted(folder / f"bent-{n}")
                    self.assertNotEqual((folder / f"bent-{n}" / "up.cert").read_bytes(), data)
                else:
                    self.until(lambda: "Only a free motion" in self.text("why"))
                    self.assertFalse(self.find("save").is_enabled())
                    self.assertTrue(self.find("contact").is_displayed() or "inside" in self.text("verdict-text"))
        self.assertEqual(seen, {"Free", "Hit"})
        self.browser.save_screenshot(str(PICTURE.with_name("arm-hit.png")))
        self.click("#reset-motion")
        self.assertEqual(self.text("verdict-title"), "Free")

    def test_links(self):
        """A link opens what it was made of."""
        self.click("#gallery a[href$=stairs]")
        self.until_scene("stairs")
        self.find("grip-1").send_keys(Keys.ARROW_UP * 3)
        self.set("clearance", 20)
        stairs = self.link(), self.poses(), self.text("verdict-title")
        self.open(self.address + "#v=1&scene=arm")
        self.until_scene("arm")
        self.set(self.browser.find_elements(By.CSS_SELECTOR, "#bends input")[1], 40)
        arm = self.link(), self.text("verdict-title")
        self.assertEqual(arm[1], "Hit")
        self.browser.get("about:blank")
        self.open(self.address + stairs[0])
        self.assertEqual((self.link(), self.poses(), self.text("verdict-title")), stairs)
        self.assertEqual(self.find("clearance").get_attribute("value"), "20")
        self.browser.get("about:blank")
        self.open(self.address + arm[0])
        self.assertEqual((self.link(), self.text("verdict-title")), arm)
        self.assertEqual(self.browser.find_elements(By.CSS_SELECTOR, "#bends output")[1].text, "40°")

    def test_links_that_are_refused(self):
        refused = {
            "v=2&scene=mug": "version", "scene=mug": "version", "v=1&scene=toString": "no scene",
            "v=1&scene=%3Cimg%20src=x%3E": "no scene", "v=1&scene=mug&evil=1": "means nothing",
            "v=1&scene=mug&scene=arm": "twice", "v=1&scene=mug&start=1,2": "start is not 7 numbers",
            "v=1&scene=mug&end=0,0,0,0,0,0,NaN": "end is not", "v=1&scene=mug&end=1e99,0,0,0,0,0,1": "end is not",
            "v=1&scene=mug&end=0,0,0,0,0,0,2": "quaternion", "v=1&scene=mug&scales=0,1": "scales",
            "v=1&scene=mug&clearance=-1": "clearance", "v=1&scene=mug&method=constructor": "no method",
            "v=1&scene=arm&bend=1,2,3": "bend is not 6", "v=1&scene=arm&bend=90,0,0,0,0,0": "bend is not",
            "v=1&scene=mug&b=my%20part.stl": "“my part.stl”, and no link holds a file", "%": "means nothing", "v=1": "no scene",
        }
        for hash, why in refused.items():
            self.browser.get("about:blank")
            self.open(f"{self.address}#{hash}")
            self.assertIn(why, self.text("notice"), hash)
            self.assertEqual((self.name(0), self.text("verdict-title")), ("A: mug.obj", "Hit"))
        self.assertEqual(self.browser.find_elements(By.CSS_SELECTOR, "img"), [])
        self.drop(0, [["my part.stl", formats(0.1)["cube.stl"]]])
        self.set_poses("0 -1 0.7 0 0 0 1", "0 1 0.55 0 0 0 1")
        link = self.link()
        self.assertIn("a=my%20part.stl", link)
        self.browser.get("about:blank")
        self.open(self.address + link)
        self.assertIn("drop it again", self.text("notice"))
        self.drop(0, [["my part.stl", formats(0.1)["cube.stl"]]])
        self.assertEqual((self.link(), self.find("notice").is_displayed()), (link, False))
        self.browser.execute_script("location.hash = '#v=1&scene=ring'")
        self.until(lambda: self.name(0) == "A: ring.obj")
        self.assertFalse(self.find("notice").is_displayed())

    def touch(self, kind: str, *points):
        self.browser.execute_cdp_cmd("Input.dispatchTouchEvent", {
            "type": kind, "touchPoints": [{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)]})

    def test_touch(self):
        """A finger drags the end of A, another turns the view, two zoom; the page does not scroll away."""
        self.look(390, 844)
        self.open(self.address)
        before = self.poses()
        grip = self.find("grip-1").rect
        x, y = grip["x"] + grip["width"] / 2, grip["y"] + grip["height"] / 2
        self.touch("touchStart", (x, y))
        for k in range(1, 6):
            self.touch("touchMove", (x - 12 * k, y - 18 * k))
        self.touch("touchEnd")
        after = self.poses()
        self.assertEqual(after[0], before[0])
        self.assertNotEqual(after[1], before[1])
        self.assert_native(native([after], "--first", "0.01")[0])
        view = self.find("view").rect
        left, low = view["x"] + 20, view["y"] + 20
        label = self.find("grip-0").rect
        self.touch("touchStart", (left, low))
        self.touch("touchMove", (left + 30, low + 20))
        self.touch("touchEnd")
        self.frames()
        turned = self.find("grip-0").rect
        self.assertNotEqual(turned, label)
        self.touch("touchStart", (left, low), (left + 60, low + 60))
        self.touch("touchMove", (left, low), (left + 140, low + 140))
        self.touch("touchEnd")
        self.frames()
        self.assertNotEqual(self.find("grip-0").rect, turned)
        self.assertEqual(self.poses(), after)
        self.assertEqual(self.browser.execute_script("return scrollY"), 0)
        self.browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})

    def test_sizes(self):
        """Verdict, witness and microseconds stand in one screen; nothing sticks out sideways, or is cut."""
        for scheme in ("light", "dark"):
            self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia",
                                         {"features": [{"name": "prefers-color-scheme", "value": scheme}]})
            for width, height in SIZES:
                self.look(width, height)
                for name in SCENES:
                    self.browser.get("about:blank")
                    self.open(f"{self.address}#v=1&scene={name}")
                    self.frames()
                    wide = self.browser.execute_script("return document.documentElement.scrollWidth - innerWidth")
                    self.assertLessEqual(wide, 0, (name, width))
                    for part in ("verdict-title", "microseconds", "point", "normal", "triangle-0", "triangle-1", "view"):
                        box = self.find(part).rect
                        self.assertLessEqual(box["y"] + box["height"], height, (part, name, width))
                        self.assertLessEqual(box["x"] + box["width"], width, (part, name, width))
                        self.assertGreaterEqual(box["x"], 0)
                    self.assertGreater(len(self.find("canvas").screenshot_as_png), 5000, "a blank one is smaller")
                    self.browser.save_screenshot(str(PICTURE.with_name(f"{name}-{width}-{scheme}.png")))
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})
        self.browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})

    def test_first_answer(self):
        self.assertLess(PAGE.stat().st_size, 1000000)
        marks = []
        for _ in range(9):
            self.browser.get("about:blank")
            time.sleep(0.5)
            self.open(self.address)
            self.until(lambda: self.browser.execute_script("return performance.getEntriesByName('seen').length"))
            marks.append(self.browser.execute_script("""
                const at = (name) => performance.getEntriesByName(name)[0].startTime;
                return [at('first-answer'), at('first-answer') - at('script'), at('module') - at('script'),
                        at('seen')];"""))
        navigation, script, module, seen = (sorted(each)[len(marks) // 2] for each in zip(*marks))
        print(f"test_page: {PAGE.name}: {PAGE.stat().st_size} bytes; first answer {navigation:.0f} ms after navigation, "
              f"seen after {seen:.0f}; {script:.0f} ms after its script begins (its module takes {module:.0f} of them), "
              f"medians of {len(marks)}; the least {min(marks)[0]:.0f} ms", flush=True)
        self.assertLess(min(marks)[0], FIRST_ANSWER)


class Firefox(unittest.TestCase):
    """The gallery in Firefox, by WebDriver BiDi on a plain socket."""

    def ask(self, method: str, **parameters) -> dict:
        self.count += 1
        self.socket.send(json.dumps({"id": self.count, "method": method, "params": parameters}))
        while True:
            reply = json.loads(self.socket.recv())
            if reply.get("method") == "log.entryAdded":
                self.log.append(reply["params"])
            if reply.get("id") == self.count:
                self.assertNotIn("error", reply)
                return reply["result"]

    def evaluate(self, expression: str):
        result = self.ask("script.evaluate", expression=expression, awaitPromise=True,
                          target={"context": self.context})
        self.assertEqual(result["type"], "success", result)
        return result["result"].get("value")

    def setUp(self):
        program = shutil.which("firefox-esr") or shutil.which("firefox")
        if not program or not websocket:
            print("test_page: no firefox or python3-websocket: not tested in Firefox", flush=True)
            self.skipTest("no firefox")
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.firefox = subprocess.Popen([program, "--headless", "--no-remote", "--remote-debugging-port", "0", "--profile",
                                         self.profile.name], stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
        address = next(line.split()[-1] for line in self.firefox.stderr if "BiDi listening" in line)
        threading.Thread(target=self.firefox.stderr.read, daemon=True).start()
        self.socket = websocket.create_connection(f"{address}/session", timeout=60, suppress_origin=True)
        self.count, self.log = 0, []
        version = self.ask("session.new", capabilities={})["capabilities"]["browserVersion"]
        self.ask("session.subscribe", events=["log.entryAdded"])
        self.context = self.ask("browsingContext.getTree")["contexts"][0]["context"]
        print(f"test_page: Firefox {version}", flush=True)

    def tearDown(self):
        self.socket.close()
        self.firefox.terminate()
        self.firefox.wait(20)
        self.firefox.stderr.close()
        self.profile.cleanup()

    def test_gallery(self):
        address = serve(PAGE.parent) + "/" + PAGE.name
        expected = {"mug": "Hit", "stairs": "Hit", "arm": "Free", "ring": "Free", "needle": "Hit"}
        for name, title in expected.items():
            self.ask("browsingContext.navigate", context=self.context, url="about:blank", wait="complete")
            self.ask("browsingContext.navigate", context=self.context, url=f"{address}#v=1&scene={name}", wait="complete")
            self.evaluate("""new Promise((done) => {
                const look = () => document.getElementById('verdict-title').textContent === 'Loading' ?
                  setTimeout(look, 20) : setTimeout(done, 600);
                look();
              })""")
            shown = self.evaluate("document.getElementById('verdict-title').textContent")
            self.assertEqual(shown, title, name)
            self.assertEqual(self.evaluate("document.getElementById('save').disabled"), False)
            self.assertEqual(self.evaluate("document.getElementById('notice').textContent"), "")
        taken = self.evaluate("performance.getEntriesByName('first-answer')[0].startTime - "
                              "performance.getEntriesByName('script')[0].startTime")
        drawn = self.evaluate("document.body.innerText.includes('no WebGL 2')")
        print(f"test_page: Firefox: five scenes, first answer {taken:.0f} ms after the script begins"
              f"{', without a picture, for want of WebGL 2' if drawn else ''}", flush=True)
        self.assertEqual([entry for entry in self.log if entry["level"] == "error"], [])


class Throw(Hands):
    page = PAGE.with_name("throw.html")

    def open(self, address: str):
        self.look(300, 400)  # without a graphics card, all is slow
        self.browser.get(address)
        self.until(lambda: self.number("count") == 12)

    def look(self, width: int, height: int):
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                     {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})

    def number(self, name: str) -> int:
        return int(self.text(name))

    def place(self) -> list:
        return [float(x) for x in re.findall(r"-?\d+\.\d\d", self.text("walker"))]

    def press(self, keys: str):
        self.browser.find_element(By.TAG_NAME, "body").send_keys(keys)

    def throw(self, x: int, y: int):
        canvas = self.find("canvas")
        ActionChains(self.browser, duration=20).move_to_element_with_offset(canvas, x, y).click().perform()

    def test_walks_throws_and_comes_to_rest(self):
        x, y, z = self.place()
        ActionChains(self.browser).key_down("d").perform()
        self.until(lambda: self.place()[2] > z + 0.5)  # up the stairs
        ActionChains(self.browser).key_up("d").perform()
        self.assertGreater(self.place()[0], x + 0.5)
        self.assertAlmostEqual(self.place()[1], y, delta=0.3)
        before = self.find("canvas").screenshot_as_base64
        self.press("5")
        self.assertEqual(self.browser.execute_script("return document.querySelector(':checked').value"), "chair")
        self.throw(60, 20)
        self.until(lambda: self.number("count") == 13 and self.number("asleep") < 13)
        self.until(lambda: self.number("questions") > 13 and self.number("contacts") > 0)
        self.until(lambda: self.number("asleep") == 13, 30)
        self.until(lambda: self.number("questions") < 13)
        self.assertNotEqual(self.find("canvas").screenshot_as_base64, before)
        self.assertEqual(self.number("overlaps"), 0)
        calls = "WebGL2RenderingContext.prototype.drawArrays = function () { window.drawn = true; }"
        self.browser.execute_script(calls)
        time.sleep(0.5)
        self.assertIsNone(self.browser.execute_script("return window.drawn"), "nothing moves, and it draws")
        self.press("q")
        self.until(lambda: self.browser.execute_script("return window.drawn"))
        self.press("r")
        self.until(lambda: self.number("count") == 12 and self.number("asleep") < 12)
        self.assertEqual(self.other(), self.address.replace("throw", "index"))

    def test_pictures(self):
        for n in range(8):
            self.press(str(n % 9 + 1))
            self.throw(30 * (n % 6) - 70, 30 * (n % 3) - 20)
        self.press(" ")
        self.until(lambda: self.number("count") > 16 and not self.text("error"))
        for width in (390, 1000):
            self.look(width, 800)
            self.frames()
            wide = self.browser.execute_script("return document.documentElement.scrollWidth")
            self.assertLessEqual(wide, width, "nothing sticks out sideways")
            self.assertGreater(len(self.find("canvas").screenshot_as_png), 10000, "a blank one is smaller")
            self.browser.save_screenshot(str(PICTURE.with_name(f"throw-{width}.png")))
        print("test_page: throw.html:", self.text("figures").replace("\n", " "), flush=True)
        self.assertEqual(self.number("overlaps"), 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
