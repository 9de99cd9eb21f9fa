"""``python3 -m tools.bench_demo``."""

from tools.demo.signals import run_command

if __name__ == "__main__":
    run_command("tools.bench_demo.command")
