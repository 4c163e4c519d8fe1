# docker build -t lather .
# docker run --rm -p 127.0.0.1:8080:8080 -v lather-data:/data lather
FROM debian:bookworm-slim AS build
WORKDIR /src
COPY cmake/packages.txt cmake/install_packages cmake/
RUN cmake/install_packages build
COPY . .
RUN cmake --preset release -DLATHER_BUILD_TESTS=OFF && cmake --build --preset release --target lather \
 && cmake --install build/release --strip --prefix /opt/lather

FROM debian:bookworm-slim
COPY cmake/packages.txt cmake/install_packages /tmp/cmake/
RUN /tmp/cmake/install_packages run && rm -rf /tmp/cmake /var/lib/apt/lists/* \
 && useradd --system --user-group --no-create-home lather && install -d -o lather -g lather /data
COPY --from=build /opt/lather /usr/local
USER lather
ENV MESA_SHADER_CACHE_DISABLE=true
VOLUME /data
EXPOSE 8080
STOPSIGNAL SIGTERM
HEALTHCHECK --interval=15s --timeout=5s --start-period=5s \
  CMD ["bash", "-c", "exec 3<>/dev/tcp/127.0.0.1/8080 && printf 'GET /healthz HTTP/1.0\\r\\nHost: 127.0.0.1\\r\\n\\r\\n' >&3 && head -n 1 <&3 | grep -q ' 200 '"]
ENTRYPOINT ["lather"]
# Within the container every address is the container's own; who may reach it is decided by -p.
CMD ["serve", "--host", "0.0.0.0", "--allow-remote", "--port", "8080", "--data", "/data"]
