"""A newcomer's way by the page: opens it, gives it two files of theirs, and prints the seconds until the verdict stands.

  ways_page.py PAGE.html A B

Chromium is started before the clock is. What a person takes to find their files is not in it.
"""
import sys
import time
from pathlib import Path

from selenium import webdriver
from selenium.webdriver.common.by import By


def main(page: str, *files: str) -> None:
    options = webdriver.ChromeOptions()
    for word in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage"):
        options.add_argument(word)
    driver = webdriver.Chrome(options=options)
    try:
        begin = time.monotonic()
        driver.get(Path(page).resolve().as_uri())
        for which, file in enumerate(files):
            driver.find_element(By.CSS_SELECTOR, f"#drop-{which} [type=file]").send_keys(str(Path(file).resolve()))
        names = [Path(file).name for file in files]
        while True:
            shown = [driver.find_element(By.CSS_SELECTOR, f"#drop-{which} .name").text for which in range(2)]
            verdict = driver.find_element(By.ID, "verdict-title").text
            if all(name in text for name, text in zip(names, shown)) and verdict == "Hit":
                break
            if time.monotonic() - begin > 60:
                raise SystemExit(f"after a minute: {verdict}, of {shown}")
            time.sleep(0.02)
        print(f"{time.monotonic() - begin:.1f}")
    finally:
        driver.quit()


if __name__ == "__main__":
    main(*sys.argv[1:])
